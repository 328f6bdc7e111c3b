#pragma once

#include <cmath>

#include "model/oscillator.hpp"

namespace clatter {
inline namespace model {

/// Stops or base that move as b sin(theta), theta = nu tau + phase, phase being that of the force; one of the two at
/// most is not 0.
struct Shaking {
  double stops = 0.0;  ///< amplitude b of both stops, any finite
  double base = 0.0;   ///< amplitude b of the base, which carries the stops, any finite
  double lead = 0.0;   ///< phase of the force in the moving frame less theta, rad; 0 until that force is in place
};

[[nodiscard]] constexpr bool is_shaken(const Shaking& shaking) { return shaking.stops != 0 || shaking.base != 0; }

/// A force that leads another phase.
struct LeadingForce {
  double amplitude = 0.0, lead = 0.0;
};

/// The force on the mass in the frame of what is shaken: forcing sin(theta) and the inertia of that frame, with moving
/// stops the spring and the damper, too, which don't move with them (eqs. 39 and 40).
[[nodiscard]] inline LeadingForce force_in_frame(const Oscillator& oscillator, const Shaking& shaking) {
  const double nu = oscillator.frequency, b = shaking.stops;
  if (b == 0) return {std::fma(shaking.base * nu, nu, oscillator.forcing), 0.0};
  const double in_phase = oscillator.forcing - b * std::fma(-nu, nu, oscillator.stiffness);
  const double quadrature = -2 * oscillator.damping * nu * b;
  if (quadrature == 0) return {in_phase, 0.0};  // a sign, no jump of the phase by pi, when the force passes 0
  return {std::hypot(in_phase, quadrature), std::atan2(quadrature, in_phase)};
}

}  // namespace model
}  // namespace clatter
