#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/number.hpp"

namespace clatter {
inline namespace scene {

namespace detail {

/// A number with its derivative by zeta.
template <class Number>
struct Differentiated {
  Number value, slope;
};

/// g = arccos(zeta) (1 - zeta^2)^(-1/2) near zeta = 1, at |1 - zeta| <= 1/4, by its series: the sum of
/// n!/(2n + 1)!! (1 - zeta)^n.
template <class Number>
[[nodiscard]] Differentiated<Number> angle_over_sine(const Number& zeta) {
  const Number u = Number(1) - zeta;
  Number term(1), slope_term(-ratio<Number>(1, 3)), value(0), slope(0);
  for (int n = 0; n < std::numeric_limits<Number>::digits / 2; ++n) {  // each some 1/8 of the one before
    value += term, slope += slope_term;
    term *= u * ratio<Number>(n + 1, 2 * n + 3);
    slope_term *= u * ratio<Number>((n + 2) * (n + 2), (n + 1) * (2 * n + 5));
  }
  return {value, slope};
}

/// -ln R = 2 zeta g of an isolated collision with a stop of the damping ratio zeta > -1/2 (eq. 55). Beyond zeta = 1 it
/// has arcosh(zeta) (zeta^2 - 1)^(-1/2) in place of g.
template <class Number>
[[nodiscard]] Differentiated<Number> logarithmic_loss(const Number& zeta) {
  using std::abs, std::atan2, std::log, std::sqrt;
  const Number u = Number(1) - zeta;
  if (4 * abs(u) <= Number(1)) {
    const auto [g, slope] = angle_over_sine(zeta);
    return {2 * zeta * g, 2 * (g + zeta * slope)};
  }
  const Number root = sqrt(abs(u)) * sqrt(Number(1) + zeta);  // of a square that may overflow
  const bool oscillates = u > Number(0);
  const Number g = (oscillates ? atan2(root, zeta) : log(zeta + root)) / root;
  return {2 * zeta * g, 2 * (oscillates ? g - zeta : zeta - g) / root / root};
}

}  // namespace detail

/// The share of its speed that an isolated collision with a soft stop of damping ratio zeta >= 0 leaves: no other
/// force, and a stop that doesn't pull (eq. 55).
template <class Number>
[[nodiscard]] Number restitution_of(const Number& zeta) {
  using std::exp;
  return exp(-detail::logarithmic_loss(zeta).value);
}

/// The damping ratio zeta of a soft stop whose isolated collisions leave the share R of the speed, 0 < R <= 1 (eq. 55
/// inverted). Newton's method finds it in double; its last steps, in the number type itself, bring the digits that this
/// type has in addition, and its derivatives.
template <class Number>
[[nodiscard]] Number damping_ratio_of(const Number& R) {
  using std::log;
  const auto improved = [](const auto& zeta, const auto& loss) {
    const auto [value, slope] = detail::logarithmic_loss(zeta);
    return zeta - (value - loss) / slope;
  };
  const double share = static_cast<double>(R), loss = -std::log(share);
  double zeta = loss < 2 ? loss / std::numbers::pi : std::exp(loss / 2) / 2;  // below, and of high damping, above
  constexpr int enough = 12, last = 3;  // steps: the first error squared twelve times, and 1e-16 three times
  for (int i = 0; i < enough; ++i) zeta = improved(zeta, loss);
  Number precise(zeta);
  const Number exact_loss = -log(R);
  for (int i = 0; i < last; ++i) precise = improved(precise, exact_loss);
  return precise;
}

}  // namespace scene
}  // namespace clatter
