#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "attractors/ensemble_motions.hpp"

namespace clatter::attractors {

/// The dimensions of a sweep, slowest first. Those of the start vary within an ensemble, the others from one ensemble
/// to another.
class Grid {
 public:
  struct Dimension {
    std::size_t length = 1;
    bool of_start = false;
  };

  explicit Grid(std::vector<Dimension> dimensions);

  [[nodiscard]] std::size_t ensembles() const { return ensembles_; }
  [[nodiscard]] std::size_t starts() const { return starts_; }  ///< of an ensemble
  /// Lengths of the dimensions of parameters, slowest first; ensembles are counted row-major over them.
  [[nodiscard]] const std::vector<std::size_t>& lengths() const { return lengths_; }
  /// Index of a point in the sweep; grows with `start`.
  [[nodiscard]] std::size_t point(std::size_t ensemble, std::size_t start) const;

 private:
  std::vector<Dimension> dimensions_;
  std::vector<std::size_t> lengths_;
  std::size_t ensembles_ = 1, starts_ = 1;
};

/// A sweep whose points have been run.
struct Endings {
  Grid grid;
  bool has_phases = false;  ///< the starts of an ensemble have several forcing phases
  std::function<point::Problem(std::size_t point)> problem;
  /// Where a point's results are kept; nothing: this shard doesn't have it.
  std::function<std::optional<std::size_t>(std::size_t point)> index;
  std::size_t count = 0;  ///< of results
  std::function<Ending(std::size_t index)> ending;
  /// Calls `work(i)` for every i < count, on several threads.
  std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)> for_each;
};

inline constexpr std::int32_t undecided = -1;  ///< instead of a number

/// A numbered motion, at the parameters of its example.
struct NumberedMotion {
  std::size_t example = 0;          ///< the first point of the sweep that ends in it
  std::size_t points = 0;           ///< that end in it
  std::size_t periods = 0;          ///< forcing periods after which it repeats; 0: none
  std::string word{}, regime{};     ///< as `ImpactWord` gives them
  SectionState state{};             ///< at forcing phase 0
  std::int32_t mirror = undecided;  ///< number of its mirror image; undecided: no start ends in it
  bool has_mirror = false;          ///< its scene is symmetric
};

struct Numbering {
  std::vector<std::int32_t> number;  ///< [index]
  std::vector<NumberedMotion> motions;
};

/// Memory that `number_motions` takes for each motion of each ensemble.
inline constexpr double bytes_of_motion = 64;

/// Gives every point the number of the motion that it ends in. Numbers count motions by their first point. A motion
/// keeps its number from ensemble to ensemble as long as it can be followed: first along the first dimension of
/// parameters, then along the others, so that in an ensemble a number stands for one motion. Throws whatever
/// `for_each` does.
[[nodiscard]] Numbering number_motions(const Endings& endings);

}  // namespace clatter::attractors
