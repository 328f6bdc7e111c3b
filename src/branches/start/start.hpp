#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "attractors/section_state.hpp"
#include "branches/equations/followed_scene.hpp"
#include "branches/equations/orbit.hpp"
#include "point/problem.hpp"

namespace clatter::branches {

/// Why a start can't be followed, and what to set instead.
struct StartError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A start that its configuration rules out, before anything runs: it asks for what the scene doesn't have.
struct SettingError : StartError {
  using StartError::StartError;
};

/// Throws SettingError if a scene's parameter can't be followed over a range from its present value on. `key` says
/// which parameter of [branch] it is: "along" or "across".
void require_start_in_range(const FollowedScene& scene, Parameter parameter, const std::array<double, 2>& range,
                            const std::string& key);

/// A speed of the order of the motion's: that of its fastest impact, or if that is hardly one, of the response.
[[nodiscard]] double speed_scale(const FollowedScene& scene, const Orbit& orbit);

/// A state of a periodic motion at a forcing phase, and the motion's period.
struct MotionStart {
  attractors::SectionState state;
  double phase = 0.0;        ///< rad
  std::int64_t periods = 1;  ///< of the force
};
/// The motion that a problem settles on, at phase 0. A problem in the frame of what is shaken. Throws StartError.
[[nodiscard]] MotionStart settled(point::Problem problem);

/// The periodic motion that a branch begins with: that which the scene settles on, or, for a period > 0 in forcing
/// periods, that near x0, v0 at the phase of the start, which may lie on a stop; kept as a half if it is its own mirror
/// image and `symmetric` scenes follow. Motion that rests is kept as a whole from its release on (`resting_orbit`).
/// Throws StartError.
[[nodiscard]] Orbit start_orbit(const StartProblem& problem, std::int64_t period, bool symmetric);

/// The events of a run over whole forcing periods; nothing if it fails. Phases are counted from the start. A problem in
/// the frame of what is shaken.
[[nodiscard]] std::optional<Orbit> event_run(const point::Problem& problem, std::size_t periods);

}  // namespace clatter::branches
