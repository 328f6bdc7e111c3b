#pragma once

#include "math/number.hpp"
#include "model/effects.hpp"

namespace clatter::motion {

/// Third to seventh derivative of the displacement by time.
template <class Number>
struct HigherDerivatives {
  Number d3, d4, d5, d6, d7;
};

/// Eq. 3, solved for the acceleration, and its derivatives by time, for every number type.
template <class Number, Effects E>
struct EquationOfMotion {
  Number twice_h, f, nu;

  /// At a displacement y from the load's equilibrium.
  [[nodiscard]] Number acceleration(const Number& y, const Number& v, const Number& sine) const {
    return next(force(f, sine), v, y);
  }
  [[nodiscard]] Number jerk(const Number& v, const Number& a, const Number& cosine) const {
    return next(force(f * nu, cosine), a, v);
  }
  [[nodiscard, gnu::always_inline]] inline HigherDerivatives<Number> derivatives(const Number& v, const Number& a,
                                                                                 const Number& sine,
                                                                                 const Number& cosine) const {
    const Number square = Number(0) - nu * nu, force3 = force(f * nu, cosine), force4 = force(f * square, sine);
    HigherDerivatives<Number> d;
    d.d3 = next(force3, a, v);
    d.d4 = next(force4, d.d3, a);
    const Number force5 = force(square, force3);
    d.d5 = next(force5, d.d4, d.d3);
    d.d6 = next(force(square, force4), d.d5, d.d4);
    d.d7 = next(force(square, force5), d.d6, d.d5);
    return d;
  }

 private:
  [[nodiscard]] static Number force(const Number& size, const Number& phase) {
    if constexpr (E.forcing == Forcing::none) return Number(0);
    return size * phase;
  }
  /// A derivative of the displacement from that of the force and from the two before.
  [[nodiscard]] Number next(const Number& derivative_of_force, const Number& last, const Number& before) const {
    if constexpr (E.damping == Damping::none) return derivative_of_force - before;
    return derivative_of_force - mul_add(twice_h, last, before);
  }
};

/// Time, forwards or backwards, in which a motion with velocity v and acceleration a covers a small distance: the
/// inverse of its Taylor series to fourth order, then a step of Newton's method on the series to sixth order. In units
/// of the time in which derivatives grow, the error is below 2^-52 if t is at most 1/64 and t a at most v/32.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Number time_over(const Number& distance, const Number& v, const Number& a,
                                                          const HigherDerivatives<Number>& d) {
  const Number inverse = Number(1) / v, c2 = a * Number(0.5), c3 = d.d3 * ratio<Number>(1, 6),
               c4 = d.d4 * ratio<Number>(1, 24);
  const Number first = distance * inverse, along = first * inverse;
  const Number k2 = c2 * along, k3 = c3 * first * along, k4 = c4 * first * (first * along);
  // 1 - k2 + (2 k2^2 - k3) - (5 k2^3 - 5 k2 k3 + k4)
  const Number square = k2 * k2, third = mul_sub(k2, mul_sub(Number(5), square, Number(5) * k3), Number(0) - k4);
  const Number t = first * ((Number(1) - k2) + (mul_sub(Number(2), square, k3) - third));
  const Number c5 = d.d5 * ratio<Number>(1, 120), c6 = d.d6 * ratio<Number>(1, 720);
  const Number left =
      neg_mul_add(t, mul_add(t, mul_add(t, mul_add(t, mul_add(t, mul_add(t, c6, c5), c4), c3), c2), v), distance);
  const Number bend = t * mul_add(t, mul_add(t, Number(4) * c4, Number(3) * c3), a) * inverse;  // of the slope
  const Number rough = mul_add(bend, bend, Number(1) - bend);                                   // of 1/(1 + bend)
  return mul_add(left * inverse, mul_add(rough, neg_mul_add(Number(1) + bend, rough, Number(1)), rough), t);
}

/// The velocity a short time t later, by the Taylor series to the seventh derivative of the displacement.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Number velocity_after(const Number& t, const Number& v, const Number& a,
                                                               const HigherDerivatives<Number>& d) {
  const Number c6 = d.d6 * ratio<Number>(1, 120), c7 = d.d7 * ratio<Number>(1, 720);
  const Number c5 = d.d5 * ratio<Number>(1, 24), c4 = d.d4 * ratio<Number>(1, 6), c3 = d.d3 * Number(0.5);
  return mul_add(t, mul_add(t, mul_add(t, mul_add(t, mul_add(t, mul_add(t, c7, c6), c5), c4), c3), a), v);
}

}  // namespace clatter::motion
