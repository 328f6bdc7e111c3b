#pragma once

#include <cstddef>
#include <functional>

#include "sweep/figure.hpp"
#include "sweep/sweep.hpp"

namespace clatter {

struct RunOptions {
  int threads = 0;  ///< OpenMP threads; 0: as many as the machine offers
  std::function<void(std::size_t done, std::size_t total)>
      progress{};  ///< called from one thread at a time, a few times a second
};

/// The results of a sweep and what they took.
struct RunResult {
  Figure figure;                  ///< coordinates, status, impact_total, simulated_periods, then what is observed
  std::size_t points = 0;         ///< points of the sweep
  std::size_t failed_points = 0;  ///< points with a status from event_budget on
  int threads = 1;                ///< threads that were used
  double seconds = 0.0;           ///< wall time of the points
  double impacts = 0.0;           ///< impacts simulated, all points together
  double periods = 0.0;           ///< forcing periods simulated, all points together
};

/// Runs every point; the same bits for every number of threads. Throws std::bad_alloc where the results don't fit into
/// memory.
[[nodiscard]] RunResult run(const Sweep& sweep, const RunOptions& options);

}  // namespace clatter
