#pragma once

#include <functional>
#include <optional>

#include "accuracy/run_record.hpp"
#include "point/problem.hpp"
#include "steady/status.hpp"

namespace clatter::accuracy {

inline constexpr std::size_t highest_harmonic = 3;  ///< that a study compares

/// What a study takes errors from: the motion of a scene in 50 digits.
struct ReferenceSolution {
  double asked = 0.0;    ///< forcing periods to compare: the duration of a transient, else the window
  double horizon = 0.0;  ///< as long as double and 50 digits agree
  steady::Status not_run = steady::Status::unresolved;  ///< of a run over no horizon: why there is none
  std::optional<RunRecord> from_start{};                ///< over the horizon, with the events that double has too
  std::optional<RunRecord> periodic{};                  ///< one period of the steady motion
  std::optional<point::Problem> on_period{};            ///< a scene that starts on it and runs for one period
  double steady_periods = 0.0;                          ///< its forcing periods, 0: none

  [[nodiscard]] double count(Event::Kind kind) const;  ///< of events within the horizon
};

/// What is observed of a run from the start: harmonics of the frequency that is nearest to the force's and turns a
/// whole number of times, since samples know no other.
[[nodiscard]] RecordObservables observables_over(const point::Problem& scene, double duration);

/// Runs a scene in double and in 50 digits. Ends early once `stopped` says so; there is nothing to compare then.
[[nodiscard]] ReferenceSolution reference_solution_of(const point::Problem& scene,
                                                      const std::function<bool()>& stopped);

}  // namespace clatter::accuracy
