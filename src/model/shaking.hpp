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
template <class Number>
struct LeadingForce {
  Number amplitude{}, lead{};
};

/// Whether a number is 0 and, if it carries derivatives, they are 0, too.
template <class Number>
[[nodiscard]] constexpr bool is_always_zero(const Number& y) {
  if constexpr (requires { y.is_constant(); }) return is_always_zero(y.value) && y.is_constant();
  return y == 0;
}

/// The force on the mass in the frame of what is shaken: f sin(theta) and the inertia of that frame, with moving stops
/// the spring and the damper, too, which don't move with them (eqs. 39 and 40). For every number type, from h, f, nu, k
/// and the two amplitudes.
template <class Number>
[[nodiscard]] LeadingForce<Number> force_in_frame(const Number& h, const Number& f, const Number& nu, const Number& k,
                                                  const Number& stops, const Number& base) {
  using std::atan2, std::fma, std::hypot;
  const Number with_base = fma(Number(base * nu), nu, f);
  if (is_always_zero(stops)) return {with_base, Number(0)};
  const Number in_phase = with_base - stops * fma(Number(-nu), nu, k);
  const Number quadrature = -2 * h * nu * stops;
  if (is_always_zero(quadrature)) return {in_phase, Number(0)};  // a sign, no jump by pi, when the force passes 0
  return {hypot(in_phase, quadrature), atan2(quadrature, in_phase)};
}
[[nodiscard]] inline LeadingForce<double> force_in_frame(const Oscillator& oscillator, const Shaking& shaking) {
  return force_in_frame(oscillator.damping, oscillator.forcing, oscillator.frequency, oscillator.stiffness,
                        shaking.stops, shaking.base);
}

}  // namespace model
}  // namespace clatter
