#pragma once

#include <functional>
#include <optional>

#include "accuracy/run_record.hpp"
#include "point/problem.hpp"
#include "steady/status.hpp"

namespace clatter::accuracy {

inline constexpr std::size_t highest_harmonic = 3;  ///< of those that are compared

/// The motion of a scene in 50 digits, from which errors are taken.
struct ReferenceSolution {
  double asked = 0.0;    ///< forcing periods to compare: the duration of a transient, else the window
  double horizon = 0.0;  ///< forcing periods over which double and 50 digits agree
  steady::Status not_run = steady::Status::unresolved;  ///< status of runs if there is no horizon: the reason
  std::optional<RunRecord> from_start{};                ///< over the horizon, with the events that double has too
  std::optional<RunRecord> periodic{};                  ///< one period of the steady motion
  std::optional<point::Problem> on_period{};            ///< a scene that starts on that motion, for one period
  double steady_periods = 0.0;                          ///< length of that period in forcing periods, 0: none

  [[nodiscard]] double count(Event::Kind kind) const;  ///< number of events of a kind within the horizon
};

/// The observables of a run from the start: harmonics of the frequency nearest to the force's that has a whole number
/// of periods in the run, since harmonics from samples need that.
[[nodiscard]] RecordObservables observables_over(const point::Problem& scene, double duration);

/// Runs a scene in double and in 50 digits. Ends early once `stopped` returns true; there is nothing to compare then.
[[nodiscard]] ReferenceSolution reference_solution_of(const point::Problem& scene,
                                                      const std::function<bool()>& stopped);

}  // namespace clatter::accuracy
