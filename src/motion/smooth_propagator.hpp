#pragma once

#include <cmath>

#include "math/number.hpp"
#include "motion/propagation.hpp"

namespace clatter::motion {

// Free motion near h^2 = k and at k = 0, by formulas without a branch (eq. 79): the others have the same values, but
// divide by lambda = |k - h^2|^(1/2) or by k, so that their derivatives by h and k lose all digits there.

/// cosh(y) - 1 and sinh(y)/y of y^2 = square, at most 1/64 in size, which may be negative.
template <class Number>
struct EvenFunctions {
  Number cosh_minus_one{}, sinh_over{1};

  explicit EvenFunctions(const Number& square) {
    constexpr int terms = 8;  // the next one is below 1e-26, and so are its derivatives
    Number power = 1;
    double factorial = 1;  // (2 n)!
    for (int n = 1; n < terms; ++n) {
      power *= square, factorial *= (2.0 * n - 1) * (2.0 * n);
      cosh_minus_one += power / factorial, sinh_over += power / (factorial * (2 * n + 1));
    }
  }
};

/// The largest |h^2 - k| s^2 that counts as near: beyond it the other formulas lose less than two digits.
inline constexpr double near_critical = 1.0 / 64;

/// The propagator of eqs. 8, 9 and 44 over a time s from (h^2 - k) s^2, at most `near_critical` in size; without A - 1.
template <class Number>
[[nodiscard]] Propagator<Number> near_critical_propagator(const Number& h, const Number& k, const Number& s,
                                                          const Number& square) {
  using std::exp;
  const EvenFunctions<Number> of(square);
  const Number decay = exp(-h * s), cosh = 1 + of.cosh_minus_one, sinh = s * of.sinh_over;
  const Number a = decay * (cosh + h * sinh), b = decay * sinh, c = decay * (cosh - h * sinh);
  return {a, b, c, 2 * h * c + k * b, {}};
}

/// The displacement a time s after rest under a unit force (eq. 45) on a spring that is as good as none: k is 0, or but
/// a derivative. It is g with g'' + 2 h g' + k g = 1: a Taylor series over a short time, which is doubled until it is
/// s, by g(2s) = (1 + A) g + g'^2.
template <class Number>
[[nodiscard]] Number pulled_by_no_spring(const Number& h, const Number& k, const Number& s) {
  int doublings = 0;
  Number time = s;
  for (; 2 * h * time > Number(0.25); ++doublings) time = time / 2;
  constexpr int terms = 14;  // (1/4)^n / n! is below rounding
  Number before = 0, last = time * time / 2, pulled = last, speed = time;
  for (int n = 3; n < terms; ++n) {  // of time^n g^(n)(0) / n!
    const Number next = -(2 * h * time * (n - 1) * last + k * time * time * before) / (n * (n - 1));
    pulled += next, speed += n * next / time, before = last, last = next;
  }
  for (; doublings > 0; --doublings) {
    const Number a = 1 - k * pulled, c = a - 2 * h * speed;
    pulled = (1 + a) * pulled + speed * speed;
    speed *= a + c;
  }
  return pulled;
}

}  // namespace clatter::motion
