#pragma once

#include <optional>
#include <vector>

#include "course.hpp"
#include "fixed_point.hpp"
#include "motion.hpp"

namespace verify {

/// A proved periodic motion, the only one whose state at the start is in a box. Without a loose mass, or if a wall
/// presses it at the start, that box is of x and x' alone.
struct Orbit {
  std::optional<FixedBox<Four>> in_flight{};
  std::optional<FixedBox<Vector>> of_two{};
  std::optional<Motion> motion{};
  std::vector<Event> events{};

  [[nodiscard]] const Ball& x() const { return in_flight ? in_flight->first[0] : of_two->first.x; }
  [[nodiscard]] const Ball& v() const { return in_flight ? in_flight->first[1] : of_two->first.y; }
  /// Whether a state is in the box.
  [[nodiscard]] bool holds(const Four& state) const {
    return in_flight ? in_flight->holds(state) : of_two->holds(verify::of_main(state));
  }
  /// The start in balls: all states of the box that may be it.
  [[nodiscard]] Four start() const {
    return in_flight ? in_flight->first : Four{{of_two->first.x, of_two->first.y, Ball(0), Ball(0)}};
  }
  /// Of motion of two numbers the other multipliers, if there are four, are 0. Nothing: they can't be told.
  [[nodiscard]] std::optional<std::vector<Vector>> multipliers() const;
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
void require_same_release(const Certificate& certificate, const Course& course, const PhaseOfRelease& first,
                          const PhaseOfRelease& last);

/// The periodic motion near the claimed start, by Newton's step and Krawczyk's operator. Throws Refuted or Undecided.
[[nodiscard]] Orbit orbit_near(const Certificate& certificate, const Scene& scene);

/// Whether the motion of one of some parts of the period repeats: then it is one.
[[nodiscard]] bool repeats_after(const Certificate& certificate, const Scene& scene, const Orbit& orbit, int parts);

/// Whether half a period takes the motion to its mirror image about a centre: the only periodic motion in the box is
/// that of its mirror image, too.
[[nodiscard]] bool returns_mirrored(const Certificate& certificate, const Scene& scene, const Orbit& orbit,
                                    const Ball& centre);

/// Refutes a claim if a motion of the claimed errors, followed up to the end, doesn't meet the claimed events.
void require_possible(const Certificate& certificate, Motion& motion, const Ball& end);

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
