#pragma once

#include <cmath>
#include <limits>

#include "math/number.hpp"
#include "motion/propagation.hpp"

namespace clatter::motion {

/// Displacements from rest of a free motion under a unit force, and under one that is the time: the first and the
/// second integral of B (eq. 7). There are three ways to compute them, each without cancellation in its range.
template <class Number>
struct Ramp {
  Number constant, growing;
};

/// By the Taylor series of B; for times in which nothing decays or turns by more than 2.
template <class Number>
[[nodiscard]] Ramp<Number> ramp_by_series(const Number& h, const Number& k, const Number& s) {
  constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 30 : 72;  // terms fall as n 2^n / n!
  const Number damping = 2 * h * s, spring = k * s * s;
  Number before(0), last = s, once = s / 2, twice = s / 6;  // before, last: two terms of B
  for (int n = 2; n < terms; ++n) {
    const Number next = -(damping * last + spring * before / (n - 1)) / n;
    before = last, last = next;
    once += next / (n + 1), twice += next / ((n + 1) * (n + 2));
  }
  return {once * s, twice * s * s};
}

/// By A and B; for times in which the spring has turned the motion, or let it creep, by 1 or more.
template <class Number>
[[nodiscard]] Ramp<Number> ramp_by_spring(const Number& h, const Number& k, const Number& s,
                                          const Propagator<Number>& free) {
  const Number once = -free.a_minus_one / k;
  return {once, ((s - free.b) - 2 * h * once) / k};
}

/// By the two modes of heavy damping, whose decay rates differ by 1/s or more.
template <class Number>
[[nodiscard]] Ramp<Number> ramp_by_modes(const Number& slow, const Number& fast, const Number& root, const Number& s) {
  using std::abs, std::expm1;
  // (1 - e^-z)/z, and (z - 1 + e^-z)/z^2
  const auto of_mode = [](const Number& z) -> Ramp<Number> {
    if (abs(z) < 1) {
      constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 20 : 44;
      Number sum(0);
      for (int n = terms; n >= 2; --n) sum = (1 - z * sum) / n;
      return {1 - z * sum, sum};
    }
    const Number once = -expm1(Number(-z)) / z;
    return {once, (1 - once) / z};
  };
  const Ramp<Number> of_slow = of_mode(Number(slow * s)), of_fast = of_mode(Number(fast * s));
  const Number over = s / (2 * root);
  return {over * (of_slow.constant - of_fast.constant), over * s * (of_slow.growing - of_fast.growing)};
}

}  // namespace clatter::motion
