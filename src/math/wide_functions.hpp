#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "math/number.hpp"
#include "math/wide_float.hpp"

namespace clatter {
inline namespace math {

// Functions of a WideFloat, to 50 digits and some more.

/// By Newton's method, of the inverse root.
[[nodiscard]] inline WideFloat sqrt(const WideFloat& x) {
  if (!(x > 0) || !isfinite(x)) return std::sqrt(static_cast<double>(x));
  const int half = x.exponent() / 2;
  const WideFloat part = ldexp(x, -2 * half);
  WideFloat inverse = 1 / std::sqrt(static_cast<double>(part));
  for (int step = 0; step < 2; ++step) inverse += ldexp(inverse * (1 - part * inverse * inverse), -1);
  const WideFloat root = part * inverse;
  return ldexp(root + ldexp((part - root * root) * inverse, -1), half);
}

namespace detail {

/// A constant in two parts, of which the first has so few bits that its products with whole numbers are exact.
struct TwoParts {
  WideFloat first, second;

  [[nodiscard]] WideFloat taken_from(const WideFloat& x, double times) const {
    return x - times * first - times * second;
  }
};
[[nodiscard]] inline const TwoParts& half_pi() {
  static const TwoParts parts{{0xc90fdaa22168c234, 0xc4c6628b80dc1cd1, 0, 1},
                              {0x29024e088a67cc74, 0x020bbea63b139b22, 0x514a08798e3404dd, -127}};
  return parts;
}
[[nodiscard]] inline const TwoParts& ln_of_two() {
  static const TwoParts parts{{0xb17217f7d1cf79ab, 0xc9e3b39803f2f6af, 0, 0},
                              {0x40f343267298b62d, 0x8a0d175b8baafa2b, 0xe7b876206debac98, -128}};
  return parts;
}

/// 1/n!
template <class Number>
[[nodiscard]] const Number& inverse_factorial_of(std::size_t n) {
  static const auto values = [] {
    std::array<Number, 48> inverse{Number(1)};
    for (std::size_t i = 1; i < inverse.size(); ++i) inverse[i] = inverse[i - 1] / static_cast<Number>(i);
    return inverse;
  }();
  return values[n];
}

/// The sum of y^j/(n + apart j)! over all j. From `terms` on they count so little that double has digits enough.
[[nodiscard, gnu::always_inline]] inline WideFloat series(const WideFloat& y, std::size_t n, std::size_t apart,
                                                          std::size_t terms) {
  const auto last = [&](std::size_t j) { return inverse_factorial_of<double>(n + apart * j); };
  const double rough = static_cast<double>(y);
  WideFloat sum = last(terms) + rough * (last(terms + 1) + rough * last(terms + 2));
  for (std::size_t j = terms; j-- > 0;) sum = sum * y + inverse_factorial_of<WideFloat>(n + apart * j);
  return sum;
}

/// sin x (first = 1) or cos x (0) by its series, |x| <= pi/4. The terms of either sign are summed apart, since a
/// processor computes two sums at once.
[[nodiscard]] inline WideFloat alternating_series(const WideFloat& x, std::size_t first) {
  const WideFloat square = x * x, fourth = square * square;
  const WideFloat sum = series(fourth, first, 4, 9) - square * series(fourth, first + 2, 4, 9);
  return first == 1 ? x * sum : sum;
}

/// sin x (first = 1) or cos x (0).
[[nodiscard]] inline WideFloat circular(const WideFloat& x, int first) {
  const double quarters = std::nearbyint(static_cast<double>(x) / 1.5707963267948966);
  if (!(std::abs(quarters) < 0x1p52)) return std::numeric_limits<double>::quiet_NaN();
  const int number = static_cast<int>(quarters - 4 * std::floor(quarters / 4)) + 1 - first;
  const WideFloat value = alternating_series(half_pi().taken_from(x, quarters), number % 2 == 0 ? 1 : 0);
  return number % 4 < 2 ? value : -value;
}

/// e^x - 1 for |x| <= 0.35: of x/2^9 by its series, then doubled nine times.
[[nodiscard]] inline WideFloat small_expm1(const WideFloat& x) {
  constexpr int doublings = 9;
  const WideFloat part = ldexp(x, -doublings), square = part * part;
  WideFloat sum = part * (series(square, 1, 2, 6) + part * series(square, 2, 2, 6));
  for (int i = 0; i < doublings; ++i) sum *= sum + 2;
  return sum;
}

/// log(1 + x), x being no more than the rounding of a double.
[[nodiscard]] inline WideFloat tiny_log1p(const WideFloat& x) { return x - x * x * (0.5 - x / 3); }

}  // namespace detail

[[nodiscard]] inline WideFloat sin(const WideFloat& x) { return detail::circular(x, 1); }
[[nodiscard]] inline WideFloat cos(const WideFloat& x) { return detail::circular(x, 0); }
[[nodiscard]] inline WideFloat tan(const WideFloat& x) { return sin(x) / cos(x); }

[[nodiscard]] inline WideFloat exp(const WideFloat& x) {
  const double whole = std::exp(static_cast<double>(x));
  if (whole == 0 || !std::isfinite(whole)) return whole;
  const double n = std::nearbyint(static_cast<double>(x) / 0.6931471805599453);
  return ldexp(detail::small_expm1(detail::ln_of_two().taken_from(x, n)) + 1, static_cast<int>(n));
}
[[nodiscard]] inline WideFloat expm1(const WideFloat& x) {
  return std::abs(static_cast<double>(x)) < 0.35 ? detail::small_expm1(x) : exp(x) - 1;
}
/// By the logarithm of the nearest double, and the series of what is left.
[[nodiscard]] inline WideFloat log(const WideFloat& x) {
  const double near = std::log(static_cast<double>(x));
  return std::isfinite(near) ? near + detail::tiny_log1p(x * exp(-WideFloat(near)) - 1) : near;
}
[[nodiscard]] inline WideFloat log1p(const WideFloat& x) {
  const double near = std::log1p(static_cast<double>(x));
  if (!std::isfinite(near)) return near;
  return near + detail::tiny_log1p((x - expm1(WideFloat(near))) * exp(-WideFloat(near)));
}
[[nodiscard]] inline WideFloat pow(const WideFloat& x, const WideFloat& y) { return exp(y * log(x)); }
/// By the angle of the nearest doubles, and the series of the angle that is left.
[[nodiscard]] inline WideFloat atan2(const WideFloat& y, const WideFloat& x) {
  const double near = std::atan2(static_cast<double>(y), static_cast<double>(x));
  const WideFloat s = sin(WideFloat(near)), c = cos(WideFloat(near)), along = x * c + y * s;
  if (along == 0 || !isfinite(along)) return near;
  const WideFloat tangent = (y * c - x * s) / along;
  return near + (tangent - tangent * tangent * tangent / 3);
}
[[nodiscard]] inline WideFloat atan(const WideFloat& x) { return atan2(x, WideFloat(1)); }
[[nodiscard]] inline WideFloat hypot(const WideFloat& x, const WideFloat& y) { return norm(x, y); }

}  // namespace math
}  // namespace clatter
