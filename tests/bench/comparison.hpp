#pragma once

#include <cstddef>
#include <limits>

#include "bench/solver_run.hpp"

namespace clatter::bench {

/// How a general solver's run differs from clatter's of the same scene.
///
/// The impacts of each stop are matched in the order of time. Two are the same when they are less than a hundredth of
/// the time to the nearest other impact apart, after the lag of the pair before is taken off: a slow drift of the
/// solver loses no impact, it shows in `error_time`. Where clatter has completed a chatter or holds the mass on a stop,
/// impacts on that stop are neither expected nor extra.
struct Comparison {
  std::size_t expected = 0;   ///< impacts in clatter's run
  std::size_t missed = 0;     ///< of them, before the solver gave up, the solver has none
  std::size_t unreached = 0;  ///< of them, after the solver gave up
  std::size_t extra = 0;      ///< impacts that clatter doesn't have
  double error_time = std::numeric_limits<double>::quiet_NaN();  ///< largest of matched impacts, in tau; NaN: none
  /// Of x at the end, over the place of a stop that is met, else over hypot(x, x'); NaN: the end was not reached.
  double error_x = std::numeric_limits<double>::quiet_NaN();
};

[[nodiscard]] Comparison compare(const SolverRun& run, const accuracy::RunRecord& course, const Stops& stops);

}  // namespace clatter::bench
