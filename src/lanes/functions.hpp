#pragma once

#include <array>
#include <cstddef>

#include "motion/propagation.hpp"

namespace clatter::lanes {

/// The Taylor series in z with coefficients sign/first!, -sign/(first + step)!, ..., cut to `count` of them so that the
/// remainder on [0, end] is as even and small as can be: Chebyshev polynomials are taken off until none of its higher
/// powers is left (economization: Lanczos 1938).
template <std::size_t count>
[[nodiscard]] consteval std::array<double, count> economized_series(int first, int step, long double sign,
                                                                    long double end) {
  constexpr std::size_t terms = 24;
  std::array<long double, terms> series{};  // by powers of z/end
  long double factorial = 1, power = sign;
  int n = 1;
  for (long double& term : series) {
    for (; n <= first; ++n) factorial *= n;
    term = power / factorial;
    first += step, power *= -end;
  }
  for (std::size_t degree = terms - 1; degree >= count; --degree) {
    long double coefficient = series[degree];  // of the Chebyshev polynomial on [0, 1] with this leading coefficient
    for (std::size_t k = degree; k > 0; --k) {
      series[k] -= coefficient;
      const auto d = static_cast<long double>(degree), j = static_cast<long double>(k);
      coefficient *= -j * (2 * j - 1) / (2 * (d - j + 1) * (d + j - 1));
    }
    series[0] -= coefficient;
  }
  std::array<double, count> cut{};
  power = 1;
  for (std::size_t i = 0; i < count; ++i, power *= end) cut[i] = static_cast<double>(series[i] / power);
  return cut;
}

/// A polynomial with the given coefficients, by Horner's rule.
template <class V, std::size_t count>
[[nodiscard, gnu::always_inline]] inline V polynomial(const std::array<double, count>& coefficients, const V& x) {
  V sum(coefficients[count - 1]);
  for (std::size_t i = count - 1; i-- > 0;) sum = mul_add(sum, x, V(coefficients[i]));
  return sum;
}

inline constexpr double longest_angle = 2.0;  ///< that the functions below take

/// The turn by an angle of 0 ... 2, to 2 ulps of 1 and to a few ulps of itself.
template <class V>
[[nodiscard, gnu::always_inline]] inline motion::Turn<V> short_turn(const V& angle) {
  static constexpr auto sine_terms = economized_series<9>(1, 2, 1, longest_angle * longest_angle);
  static constexpr auto cosine_terms = economized_series<9>(2, 2, -1, longest_angle * longest_angle);
  const V square = angle * angle;
  return {angle * polynomial(sine_terms, square), square * polynomial(cosine_terms, square)};
}

/// A turn by an angle of at most 2^-8.
template <class V>
[[nodiscard]] motion::Turn<V> tiny_turn(const V& angle) {
  static constexpr std::array sine_terms{1.0, -1.0 / 6, 1.0 / 120};
  static constexpr std::array cosine_terms{-1.0 / 2, 1.0 / 24};
  const V square = angle * angle;
  return {angle * polynomial(sine_terms, square), square * polynomial(cosine_terms, square)};
}

/// (z - 1 + e^-z)/z^2 for 0 <= z <= 2 (eq. 45), to 2 ulps of 1.
template <class V>
[[nodiscard, gnu::always_inline]] inline V short_second_divided_decay(const V& z) {
  static constexpr auto terms = economized_series<14>(2, 1, 1, longest_angle);
  return polynomial(terms, z);
}

/// e^-x for 0 <= x <= 2, to 2 ulps of 1: the square of e^(-x/2), both less 1.
template <class V>
[[nodiscard, gnu::always_inline]] inline V short_decay(const V& x) {
  static constexpr auto terms = economized_series<12>(1, 1, 1, longest_angle / 2);
  const V half = x * V(0.5), less = half * polynomial(terms, half);
  return V(1.0) - neg_mul_add(less, less, less + less);
}

/// The propagator of two exponentials over a time 0 <= s <= 2/(h + lambda), from h and k - h^2 = -lambda^2 <= 0, to
/// some ulps of its largest coefficient: eq. 8 with hyperbolic functions. Its d is not that of eq. 43.
template <class V>
[[nodiscard, gnu::always_inline]] inline motion::Propagator<V> short_propagator(const V& s, const V& h,
                                                                                const V& root_square) {
  static constexpr auto sinh_terms = economized_series<9>(1, 2, 1, -longest_angle * longest_angle);
  static constexpr auto cosh_terms = economized_series<9>(2, 2, -1, -longest_angle * longest_angle);
  const V z = root_square * (s * s);
  return motion::light_propagator(short_decay(h * s), mul_add(z, polynomial(cosh_terms, z), V(1.0)),
                                  s * polynomial(sinh_terms, z), h);
}

}  // namespace clatter::lanes
