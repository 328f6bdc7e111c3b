#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Points that run one after the other: along `follow` a whole branch, else a single point.
struct Branches {
  std::size_t count = 0, length = 1, stride = 1;

  explicit Branches(const Sweep& sweep) : count(size(sweep)) {
    if (!sweep.follow) return;
    length = clatter::sweep::length(sweep.dimensions[*sweep.follow]);
    for (std::size_t d = *sweep.follow + 1; d < sweep.dimensions.size(); ++d)
      stride *= clatter::sweep::length(sweep.dimensions[d]);
    count /= length;
  }
  /// Index of the i-th point of a branch.
  [[nodiscard]] std::size_t point(std::size_t branch, std::size_t i) const {
    return (branch / stride * length + i) * stride + branch % stride;
  }
  /// Whether a point begins its branch, so that its start is known before anything runs.
  [[nodiscard]] bool begins(std::size_t point) const { return point / stride % length == 0; }
};

/// Starts a point of a branch from the end of the one before, or from the scene's own start if that one failed. A
/// displacement beyond narrower stops is moved onto the stop, the velocity kept.
inline void start_from(point::Problem& problem, const std::optional<Start>& end) {
  if (end) problem.start = *end;
  problem.start.displacement = std::clamp(problem.start.displacement, problem.stops.lower, problem.stops.upper);
}

}  // namespace clatter::sweep
