#pragma once

#include <algorithm>
#include <cmath>

#include "math/number.hpp"
#include "scene/oscillator.hpp"

namespace clatter {
inline namespace scene {

/// Steady forced response P sin(theta) + Q cos(theta) of eq. 3 (eq. 6): P = f(k - nu^2)/D, Q = -2 h nu f/D,
/// D = (k - nu^2)^2 + (2 h nu)^2. Infinite or NaN if there is none: f at h = 0, k = nu^2.
template <class Number>
struct Response {
  Number in_phase{}, quadrature{};  ///< P and Q
  Number amplitude{};               ///< (P^2 + Q^2)^(1/2)

  [[nodiscard]] Number displacement(const Number& sine, const Number& cosine) const {
    return mul_add(in_phase, sine, quadrature * cosine);
  }
  [[nodiscard]] Number velocity(const Number& nu, const Number& sine, const Number& cosine) const {
    return nu * mul_sub(in_phase, cosine, quadrature * sine);
  }
};

/// From the dynamic stiffness k - nu^2 and h, f, nu.
template <class Number>
[[nodiscard]] Response<Number> response_to(const Number& dynamic_stiffness, const Number& h, const Number& f,
                                           const Number& nu) {
  using std::abs, std::max;
  if (f == 0) return {};
  const Number friction = 2 * h * nu;
  const Number size =
      max(Number(abs(dynamic_stiffness)), friction);  // divided out first, so that its square can't overflow or vanish
  const Number p = dynamic_stiffness / size, q = friction / size, determinant = size * (p * p + q * q);
  const Number in_phase = f * p / determinant, quadrature = -f * q / determinant;
  return {in_phase, quadrature, norm(in_phase, quadrature)};
}

/// With k = 1.
template <class Number>
[[nodiscard]] Response<Number> steady_response(const Number& h, const Number& f, const Number& nu) {
  return response_to(Number((1 - nu) * (1 + nu)), h, f, nu);
}
[[nodiscard]] inline Response<double> steady_response(const Oscillator& o) {
  if (o.stiffness == 1.0) return steady_response(o.damping, o.forcing, o.frequency);
  return response_to(o.stiffness - o.frequency * o.frequency, o.damping, o.forcing, o.frequency);
}

}  // namespace scene
}  // namespace clatter
