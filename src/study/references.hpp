#pragma once

#include <functional>
#include <optional>

#include "dynamics/scene.hpp"
#include "study/course.hpp"

namespace clatter {

inline constexpr std::size_t highest_harmonic = 3;  ///< that a study compares

/// What a study takes errors from: the motion of a scene in 50 digits.
struct References {
  double asked = 0.0;                   ///< forcing periods to compare: the duration of a transient, else the window
  double horizon = 0.0;                 ///< as long as double and 50 digits agree
  Status not_run = Status::unresolved;  ///< of a run over no horizon: why there is none
  std::optional<Course> from_start{};   ///< over the horizon, with the events that double has too
  std::optional<Course> periodic{};     ///< one period of the steady motion
  std::optional<Scene> on_period{};     ///< a scene that starts on it and runs for one period
  double steady_periods = 0.0;          ///< its forcing periods, 0: none

  [[nodiscard]] double count(Event::Kind kind) const;  ///< of events within the horizon
};

/// What is observed of a run from the start: harmonics of the frequency that is nearest to the force's and turns a
/// whole number of times, since samples know no other.
[[nodiscard]] CourseObservables observables_over(const Scene& scene, double duration);

/// Runs a scene in double and in 50 digits. Ends early once `stopped` says so; there is nothing to compare then.
[[nodiscard]] References references_of(const Scene& scene, const std::function<bool()>& stopped);

}  // namespace clatter
