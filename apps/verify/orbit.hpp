#pragma once

#include <optional>
#include <vector>

#include "course.hpp"

namespace verify {

/// A proved periodic motion, the only one whose state at the start is in a box.
struct Orbit {
  Motion motion;
  std::vector<Event> events;
  Matrix derivative;    ///< of a period
  Vector start, width;  ///< the box
  Vector first;         ///< where in it the motion starts

  /// Whether a state is in the box.
  [[nodiscard]] bool holds(const Vector& state) const {
    return (start.x + Ball::around_zero(width.x)).holds_inside(state.x) &&
           (start.y + Ball::around_zero(width.y)).holds_inside(state.y);
  }
};

/// So many forcing periods.
[[nodiscard]] Ball length_of(const Scene& scene, long periods);

/// Periodic motion without an event.
struct Response {
  Vector start;
  Ball x_min, x_max;
  Matrix derivative;  ///< of the claimed period
};

/// The steady response of a claim without events, if it is proved to keep clear of all; else nothing.
[[nodiscard]] std::optional<Response> steady_response(const Certificate& certificate, const Scene& scene);

/// Throws Refuted if a motion that starts with a release doesn't end with the same one after the claimed periods, or
/// does so before.
void require_same_release(const Certificate& certificate, const Course& course, slong periods);

/// The periodic motion near a start, by Newton's step and Krawczyk's operator. Throws Refuted or Undecided.
[[nodiscard]] Orbit periodic_orbit(const Certificate& certificate, const Scene& scene, long periods);

/// The periodic motion that a certificate claims, resting or not. Throws Refuted or Undecided.
[[nodiscard]] Orbit claimed_orbit(const Certificate& certificate, const Scene& scene);

}  // namespace verify
