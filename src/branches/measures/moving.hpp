#pragma once

#include <cmath>
#include <vector>

#include "branches/equations/equations.hpp"
#include "math/dual.hpp"

namespace clatter::branches {

/// An event of an orbit with its derivatives along a branch.
struct MovingEvent {
  Side side;
  Along phase, coordinate;  ///< as that of `OrbitEvent`
  bool rests;               ///< the next contact is a rest: this impact and those that follow lose all
  Event::Kind kind = Event::Kind::impact;
  Along other_place{}, other_before{};  ///< likewise
  Side pressed = Side::none;            ///< the soft stop that the mass is in contact with from then on
};
/// A scene's numbers and an orbit's events with their derivatives along a branch.
struct Moving {
  FollowedScene scene;
  SceneNumbers<Along> p;
  std::vector<MovingEvent> events;
  Along period;               ///< of the events as they are kept, in tau
  Side pressed = Side::none;  ///< as that of `Orbit`
  bool soft = false;          ///< whether it meets soft stops
  bool stiffness_varies = false;
};
/// Along a tangent of equations.
[[nodiscard]] Moving moving(const OrbitEquations& equations, const Vector& point, const Vector& tangent);
/// Along a parameter, for a motion that rests: its impacts follow from the release. Those of a chatter that ends in
/// rest don't move.
[[nodiscard]] Moving moving_from_release(const FollowedScene& scene, const Orbit& orbit, Parameter parameter);

/// Whether a quantity changes by more than rounding. The impact speed of a bouncing ball doesn't: gravity alone gives
/// it.
[[nodiscard]] inline bool changes(const Along& measure) {
  return std::abs(measure.slope[0]) > 1e-11 * std::abs(measure.value);
}

/// Quantities that have maxima along a branch: speed of the fastest impact, energy lost in impacts per tau, and
/// amplitude of the harmonic of x at the forcing frequency (eq. 28; of motion that doesn't rest).
[[nodiscard]] Along impact_speed(const Moving& moving);
[[nodiscard]] Along impact_power(const Moving& moving);
[[nodiscard]] Along harmonic(const Moving& moving);

/// Energy lost in an impact, per unit mass, or on a wall per unit of the main mass (eq. 70).
template <class Number>
[[nodiscard]] Number lost_in_impact(const SceneNumbers<Number>& p, Event::Kind kind, Side side, const Number& before,
                                    bool rests) {
  const Number lost = rests ? Number(before * before / 2) : law_at(p, kind, side).lost(before);
  return kind == Event::Kind::strike ? Number(motion::WallRule<Number>(p.loose).share() * lost) : lost;
}
/// The energy that soft stops take in one repetition of a motion.
[[nodiscard]] double loss_on_soft_stops(const FollowedScene& scene, const Orbit& orbit);

}  // namespace clatter::branches
