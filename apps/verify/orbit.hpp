#pragma once

#include <optional>
#include <vector>

#include "course.hpp"
#include "fixed_point.hpp"
#include "motion.hpp"

namespace verify {

/// A proved periodic motion, the only one whose state at the start is in a box.
struct Orbit : FixedBox<Vector> {
  Motion motion;
  std::vector<Event> events;
  Matrix derivative;  ///< of a period
};

/// So many forcing periods.
[[nodiscard]] Ball length_of(const Scene& scene, long periods);

/// Periodic motion without an event.
struct Response {
  bool within_stop = false;  ///< all the time, a soft one
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

/// Refutes a claim if a motion of the claimed errors, followed up to the end, doesn't meet the claimed events.
void require_possible(const Certificate& certificate, Followed& motion, const Ball& end);

/// The motion that `find` finds near the claimed one. If it can't tell, or refutes motion from the middle of the
/// claimed errors, `require_one` refutes the claim if no motion of these errors is as claimed; else it is undecided.
template <class Find, class Require>
[[nodiscard]] auto found_or_undecided(const Find& find, const Require& require_one) -> decltype(find()) {
  try {
    return find();
  } catch (const Undecided&) {
    require_one();
    throw;
  } catch (const Refuted& near) {
    require_one();
    throw Undecided(near.what());
  }
}

/// The periodic motion that a certificate claims, resting or not. Throws Refuted or Undecided.
[[nodiscard]] Orbit claimed_orbit(const Certificate& certificate, const Scene& scene);

}  // namespace verify
