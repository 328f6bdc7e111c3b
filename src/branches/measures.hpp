#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "branches/equations.hpp"
#include "math/dual.hpp"
#include "observables/extrema.hpp"

namespace clatter::branches {

/// Multipliers of an orbit over its whole period, and whether both lie within the unit circle. A rest forgets all that
/// went before it: both are zero then.
struct Multipliers {
  std::array<double, 2> re, im;  ///< the one of larger modulus first
  bool stable;
};
[[nodiscard]] Multipliers multipliers(const ShakenScene& scene, const Orbit& orbit);

/// The state when the forcing phase is 0.
[[nodiscard]] PhasePoint state_at_phase_zero(const ShakenScene& scene, const Orbit& orbit);

/// Least and greatest displacement and velocity.
[[nodiscard]] observables::Extrema extrema(const ShakenScene& scene, const Orbit& orbit);

/// Speed of the fastest impact.
[[nodiscard]] double impact_speed(const Orbit& orbit);
/// Energy lost on the stops per tau, of the mass over that at the start: in impacts (eq. 33), in contacts with soft
/// stops (eq. 54); a chatter that ends in rest loses all that it has.
[[nodiscard]] double impact_power(const ShakenScene& scene, const Orbit& orbit);

/// A scene's parameters and an orbit's impacts with their derivatives along a branch.
using Along = Dual<double, 1>;
struct Moving {
  ShakenScene scene;
  Parameters<Along> p;
  struct Impact {
    Side side;
    Along phase, before;
    bool rests;  ///< the next contact is a rest: this impact and those that follow lose all
    Event event = Event::impact;
  };
  std::vector<Impact> impacts;
  Along period;               ///< of the impacts as they are kept, in tau
  Side pressed = Side::none;  ///< of motion without events: the soft stop that it is always in contact with
  bool soft = false;          ///< whether it meets soft stops
  bool stiffness_varies = false;
};
/// Along a tangent of equations.
[[nodiscard]] Moving moving(const OrbitEquations& equations, const Vector& point, const Vector& tangent);
/// Along a parameter, for a motion that rests: its impacts follow from the release. Those of a chatter that ends in
/// rest don't move.
[[nodiscard]] Moving moving_from_release(const ShakenScene& scene, const Orbit& orbit, sweep::Parameter parameter);

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

}  // namespace clatter::branches
