#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/tally.hpp"
#include "file_points.hpp"
#include "results/dataset.hpp"
#include "sweep/sweep.hpp"

namespace clatter::app {

/// An output of `clatter run` whose points are run anew and certified.
class CertifiedFile {
 public:
  /// Reads the configuration, and the results that are compared. Throws UsageError, IoError, ChoiceError.
  CertifiedFile(const std::string& path, const std::vector<Place>& where);

  [[nodiscard]] const std::vector<std::size_t>& points() const { return points_; }  ///< those chosen, ascending

  /// Passes on the certificates of some points, one a line; along `follow` in the order of chains.
  [[nodiscard]] certificates::Tally certify(const std::vector<std::size_t>& points,
                                            const std::function<void(std::string_view line)>& take) const;

 private:
  [[nodiscard]] bool is_reproduced(std::size_t point, const certificates::CertifiedPoint& found) const;

  sweep::Sweep sweep_;
  results::Dataset results_{};  ///< status and, if the file has them, period_ratio and impact_word
  std::vector<std::size_t> points_{};
};

}  // namespace clatter::app
