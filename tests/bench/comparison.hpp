#pragma once

#include <cstddef>
#include <limits>

#include "bench/solver_run.hpp"

namespace clatter::bench {

/// The differences of a general solver's run from clatter's of the same scene.
///
/// The impacts of each stop are matched in the order of time. Two are the same if, less the lag of the pair before,
/// they are less than a hundredth of the time to the nearest other impact apart: a slow drift of the solver loses no
/// impact, but shows in `error_time`. While clatter has completed a chatter or holds the mass on a stop, impacts on
/// that stop are neither expected nor extra.
struct Comparison {
  std::size_t expected = 0;   ///< impacts in clatter's run
  std::size_t missed = 0;     ///< those before the solver gave up that it doesn't have
  std::size_t unreached = 0;  ///< those after the solver gave up
  std::size_t extra = 0;      ///< impacts that clatter doesn't have
  double error_time = std::numeric_limits<double>::quiet_NaN();  ///< largest of matched impacts, in tau; NaN: none
  /// Error of x at the end, over the position of a stop that is met, else over hypot(x, x'); NaN: end not reached.
  double error_x = std::numeric_limits<double>::quiet_NaN();
};

[[nodiscard]] Comparison compare(const SolverRun& run, const accuracy::RunRecord& record, const Stops& stops);

}  // namespace clatter::bench
