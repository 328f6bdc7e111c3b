#pragma once

#include <array>
#include <cstddef>

namespace clatter::lanes {

/// The inverse factorials 1/(first + 2 i)!, i = 0 ... count - 1, of alternating sign.
template <std::size_t count>
[[nodiscard]] constexpr std::array<double, count> alternating_series(int first, int step) {
  std::array<double, count> terms{};
  double factorial = 1.0, sign = 1.0;
  int n = 1;
  for (double& term : terms) {
    for (; n <= first; ++n) factorial *= n;
    term = sign / factorial;
    first += step, sign = -sign;
  }
  return terms;
}

/// A polynomial with the given coefficients, by Horner's rule.
template <class V, std::size_t count>
[[nodiscard, gnu::always_inline]] inline V polynomial(const std::array<double, count>& coefficients, const V& x) {
  V sum(coefficients[count - 1]);
  for (std::size_t i = count - 1; i-- > 0;) sum = fma(sum, x, V(coefficients[i]));
  return sum;
}

template <class V>
struct SineAndCosine {
  V sine, cosine;
};

/// Sine and cosine of 0 <= x <= 2.2, to 4 ulps of 1: the Taylor series of half the angle.
template <class V>
[[nodiscard, gnu::always_inline]] inline SineAndCosine<V> short_sine_cosine(const V& x) {
  static constexpr auto sine_terms = alternating_series<9>(1, 2);
  static constexpr auto cosine_terms = alternating_series<10>(0, 2);
  const V half = x * 0.5, square = half * half;
  const V sine = half * polynomial(sine_terms, square), cosine = polynomial(cosine_terms, square);
  const V twice = sine + sine;
  return {twice * cosine, fnma(twice, sine, V(1.0))};
}

/// e^-x for 0 <= x <= 2.2, to 2 ulps of 1: e^(-x/8) - 1 by the Taylor series, doubled three times.
template <class V>
[[nodiscard, gnu::always_inline]] inline V short_decay(const V& x) {
  static constexpr auto terms = alternating_series<12>(1, 1);
  const V part = x * 0.125;
  V less = part * polynomial(terms, part);  // 1 - e^(-x/8)
  less = fnma(less, less, less + less);
  less = fnma(less, less, less + less);
  less = fnma(less, less, less + less);
  return V(1.0) - less;
}

}  // namespace clatter::lanes
