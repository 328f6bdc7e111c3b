#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "math/number.hpp"

namespace clatter::motion {

/// (e^z - 1)/z for z = re + i im with re <= 0, the divided difference of the exponential (eq. 11), to relative accuracy
/// for every z.
template <class Number>
[[nodiscard]] std::array<Number, 2> divided_exponential(const Number& re, const Number& im) {
  using std::cos, std::exp, std::expm1, std::sin, std::sqrt;
  const Number square = re * re + im * im;
  if (square < sqrt(epsilon<Number>())) {  // 1 + z/2 + z^2/6 + z^3/24: the next term is below rounding
    const Number re2 = (re - im) * (re + im), im2 = 2 * re * im;
    return {1 + re / 2 + re2 / 6 + (re * re2 - im * im2) / 24, im / 2 + im2 / 6 + (re * im2 + im * re2) / 24};
  }
  const Number half = sin(im / 2), u = expm1(re) * cos(im) - 2 * half * half, w = exp(re) * sin(im);
  return {(u * re + w * im) / square, (w * re - u * im) / square};
}

/// (z - 1 + e^-z)/z^2 for z >= 0, to relative accuracy (eq. 45).
template <class Number>
[[nodiscard]] Number second_divided_decay(const Number& z) {
  using std::expm1;
  if (z >= 1) return (z + expm1(-z)) / (z * z);
  constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 18 : 42;  // 1/terms! is below rounding
  Number sum = 0;
  for (int k = terms; k >= 2; --k) sum = (1 - z * sum) / k;  // 1/2! - z/3! + z^2/4! - ...
  return sum;
}

/// y z^6, one factor at a time, so that 0 meets infinity only if y or z is not finite.
template <class Number>
[[nodiscard]] Number times_sixth_power(const Number& y, const Number& z) {
  return y * z * z * z * z * z * z;
}

}  // namespace clatter::motion
