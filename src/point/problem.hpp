#pragma once

#include <optional>

#include "observables/all.hpp"
#include "scene/given_scene.hpp"
#include "steady/time_settings.hpp"
#include "stepping/integration.hpp"

namespace clatter::point {

/// All but the scene that results depend on.
struct RunSettings {
  steady::TimeSettings time;
  observables::Observe observe;
  stepping::Integration integration;
};

/// One point of a sweep: a scene, and how it is run and observed.
struct Problem : Scene, RunSettings {
  Units units{};                      ///< of all its numbers
  std::optional<GivenScene> given{};  ///< the user's numbers, for derivatives by them and for more digits of them
};

/// The forcing phase theta, as the scene gives it, a time after the start of a problem, rad.
[[nodiscard]] inline double forcing_phase(const Problem& problem, double after = 0.0) {
  return problem.start.phase - problem.shaking.lead + problem.oscillator.frequency * after;
}

/// The factor of the shaking in the motion that is added to the computed one: 1 if absolute motion is asked for, and
/// with a loose mass, whose motion is computed as the ground sees it, -1 if relative motion is; else 0.
[[nodiscard]] inline int frame_sign(const Problem& problem) {
  return (problem.observe.frame == Frame::absolute ? 1 : 0) - (has_loose_mass(problem.loose) ? 1 : 0);
}

/// The motion that is added to the computed one, from the start of a problem on, or from a time after it, if something
/// is shaken.
[[nodiscard]] inline std::optional<FrameMotion> observed_frame(const Problem& problem, double after = 0.0) {
  const int sign = frame_sign(problem);
  if (sign == 0 || !is_shaken(problem.shaking)) return std::nullopt;
  const FrameMotion frame(problem.shaking, problem.oscillator, forcing_phase(problem, after));
  return sign < 0 ? frame.reversed() : frame;
}

/// The limits of a run of a problem.
[[nodiscard]] inline stepping::Limits limits_of(const Problem& problem) {
  return limits_of(problem.time, problem.oscillator);
}

}  // namespace clatter::point
