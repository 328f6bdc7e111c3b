#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "point/point.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Points of a sweep whose motion is the mirror image of another point's: between symmetric stops without a load the
/// start (-x0, -v0) half a forcing period later, without a force at any time. Of such a pair only the first is run.
/// That needs axes of starts that are their own mirror images to rounding, phases half a turn apart, and observables
/// whose mirror image follows from their values.
class MirrorImages {
 public:
  explicit MirrorImages(const Sweep& sweep);

  [[nodiscard]] bool exist() const { return count_ > 0; }
  [[nodiscard]] std::size_t count() const { return count_; }  ///< points that come after the one whose image they are

  /// The other point of the pair, whichever comes first; nothing if the point has no mirror image.
  [[nodiscard]] std::optional<std::size_t> image_of(std::size_t point) const;
  /// The point whose mirror image a point is, if that comes before it.
  [[nodiscard]] std::optional<std::size_t> original_of(std::size_t point) const {
    const auto image = image_of(point);
    return image && *image < point ? image : std::nullopt;
  }

 private:
  std::size_t points_ = 0, count_ = 0;
  std::vector<std::vector<std::size_t>> images_;  ///< [dimension][index]: the index of the mirror image; empty: none
};

/// The result of the mirror image of a point.
[[nodiscard]] point::PointResult mirrored(const point::PointResult& result);

}  // namespace clatter::sweep
