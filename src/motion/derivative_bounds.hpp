#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "math/number.hpp"
#include "motion/equation_of_motion.hpp"

namespace clatter::motion {

/// Bounds of the sixth and the next derivatives of a displacement (eq. 14).
template <class Number, std::size_t count = 2>
struct DerivativeBounds {
  std::array<Number, count> free{};    ///< over the energy norm; of k > 0 only
  std::array<Number, count> forced{};  ///< of the force's part of the same derivatives, in secular motion from rest
  std::array<Number, count> by_value{}, by_slope{};  ///< of the same over s and ds/dtheta, if the force is in pieces
};

/// By the recursion that eq. 3 is for its derivatives; `natural` is |k|^(1/2).
template <std::size_t count = 2, class Number, Effects E>
[[nodiscard]] DerivativeBounds<Number, count> derivative_bounds(const EquationOfMotion<Number, E>& equation,
                                                                const Number& natural) {
  using std::abs;
  const auto spring = [&](const Number& y) -> Number {
    if constexpr (E.stiffness) return equation.k * y;
    return y;
  };
  DerivativeBounds<Number, count> bounds;
  Number x_part = 1, v_part = 0;  // x^(order) = x_part x + v_part v + f Im(e^{i theta} (re + i im))
  Number re = 0, im = 0, next_re = 0, next_im = 0;
  Number power_re = 1, power_im = 0;  // (i nu)^order
  for (std::size_t order = 0; order < 6 + count; ++order) {
    Number per_energy = x_part;
    if constexpr (E.stiffness) per_energy = natural > 0 ? Number(x_part / natural) : Number(0);
    if (order >= 6) {
      bounds.free[order - 6] = norm(per_energy, v_part);
      bounds.forced[order - 6] = abs(equation.f) * norm(re, im);
      bounds.by_value[order - 6] = abs(equation.f * re), bounds.by_slope[order - 6] = abs(equation.f * im);
    }
    const Number x_next = -spring(v_part), v_next = x_part - equation.twice_h * v_part;
    x_part = x_next, v_part = v_next;
    const Number after_re = -equation.twice_h * next_re - spring(re) + power_re,
                 after_im = -equation.twice_h * next_im - spring(im) + power_im;
    re = next_re, im = next_im, next_re = after_re, next_im = after_im;
    Number turned = -equation.nu * power_im;
    if constexpr (E.stiffness) turned = equation.curl * turned;
    power_im = equation.nu * power_re, power_re = turned;
  }
  return bounds;
}

}  // namespace clatter::motion
