#pragma once

#include <cmath>

#include "motion/arc.hpp"
#include "motion/contact.hpp"

namespace clatter::motion {

/// First contact of a scene that starts at (x, v) with phase 0, within a time `horizon`.
inline Crossing<double> first_contact(const Oscillator& oscillator, const Stops& stops, double x, double v,
                                      double horizon) {
  return with_any_stops(oscillator, [&]<Effects effects>() {
    const ArcConstants<double, effects.arc()> constants(oscillator);
    const Arc<double, effects.arc()> arc(
        constants, {0, x, v, constants.acceleration(x - constants.equilibrium, v, {0.0, 1.0}), 0, 1});
    return next_contact(arc, stops, horizon);
  });
}

/// The linear steady state h = 0.1, f = 1, nu = 1.5 at phase 0 (eqs. 5 and 6); a stop near its amplitude is grazed
/// (eq. 20).
namespace graze {
inline constexpr Oscillator oscillator{0.1, 1.0, 1.5, 0.0};
inline constexpr double amplitude = 0.777909841584413976, x0 = -0.181543116490166415, v0 = -1.13464447806354009;
inline Stops stops(double epsilon) { return {-amplitude * (1 - epsilon), amplitude * (1 - epsilon), 0.7, 0.7}; }
}  // namespace graze

}  // namespace clatter::motion
