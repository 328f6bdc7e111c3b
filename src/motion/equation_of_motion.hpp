#pragma once

#include <array>

#include "math/number.hpp"
#include "scene/effects.hpp"

namespace clatter::motion {

/// Third to sixth derivative of the displacement by time.
template <class Number>
struct HigherDerivatives {
  Number d3, d4, d5, d6;
};

/// Eq. 3, solved for the acceleration, and its derivatives by time, for every number type.
template <class Number, Effects E>
struct EquationOfMotion {
  Number twice_h, f, nu;
  Number k{1.0};           ///< stiffness; not read unless it is an effect
  Number unbalanced{0.0};  ///< the load, if no spring balances it; likewise
  Number curl{1.0};        ///< w^2 of the shape of the force, s'' = -w^2 s by the phase; likewise

  /// At a displacement y from the load's equilibrium.
  [[nodiscard]] Number acceleration(const Number& y, const Number& v, const Number& sine) const {
    if constexpr (E.stiffness) return next(force(f, sine) + unbalanced, v, y);
    return next(force(f, sine), v, y);
  }
  [[nodiscard]] Number jerk(const Number& v, const Number& a, const Number& cosine) const {
    return next(force(f * nu, cosine), a, v);
  }
  [[nodiscard, gnu::always_inline]] inline HigherDerivatives<Number> derivatives(const Number& v, const Number& a,
                                                                                 const Number& sine,
                                                                                 const Number& cosine) const {
    const Number square = curled(Number(0) - nu * nu), force3 = force(f * nu, cosine), force4 = force(f * square, sine);
    HigherDerivatives<Number> d;
    d.d3 = next(force3, a, v);
    d.d4 = next(force4, d.d3, a);
    d.d5 = next(force(square, force3), d.d4, d.d3);
    d.d6 = next(force(square, force4), d.d5, d.d4);
    return d;
  }
  /// From derivatives of s by the phase.
  [[nodiscard]] HigherDerivatives<Number> derivatives(const Number& v, const Number& a,
                                                      const std::array<Number, 5>& s) const {
    HigherDerivatives<Number> d;
    d.d3 = next(force(f * nu, s[1]), a, v);
    d.d4 = next(force(f * nu * nu, s[2]), d.d3, a);
    d.d5 = next(force(f * nu * nu * nu, s[3]), d.d4, d.d3);
    d.d6 = next(force(f * nu * nu * nu * nu, s[4]), d.d5, d.d4);
    return d;
  }

 private:
  /// A second derivative by the phase, which lanes take of sines alone.
  [[nodiscard]] Number curled(const Number& y) const {
    if constexpr (E.stiffness && !requires { typename Number::Batch; }) return curl * y;
    return y;
  }
  [[nodiscard]] static Number force(const Number& size, const Number& phase) {
    if constexpr (E.forcing == Forcing::none) return Number(0);
    return size * phase;
  }
  /// A derivative of the displacement from that of the force and from the two before.
  [[nodiscard]] Number next(const Number& derivative_of_force, const Number& last, const Number& before) const {
    if constexpr (E.stiffness) return derivative_of_force - mul_add(twice_h, last, k * before);
    if constexpr (E.damping == Damping::none) return derivative_of_force - before;
    return derivative_of_force - mul_add(twice_h, last, before);
  }
};

/// Time, forwards or backwards, in which a motion with velocity v and acceleration a covers a small distance: the
/// inverse of its Taylor series to third order, then a step of Newton's method on the series to fifth order.
template <class Number>
struct TimeOver {
  Number time;
  Number rough;       ///< before the step of Newton's method
  Number correction;  ///< that step
  Number bend;        ///< relative change of the velocity on the way

  [[gnu::always_inline]] inline TimeOver(const Number& distance, const Number& v, const Number& a,
                                         const HigherDerivatives<Number>& d) {
    const Number inverse = Number(1) / v, c2 = a * Number(0.5), c3 = d.d3 * ratio<Number>(1, 6),
                 c4 = d.d4 * ratio<Number>(1, 24), c5 = d.d5 * ratio<Number>(1, 120);
    const Number first = distance * inverse, along = first * inverse, k2 = c2 * along, k3 = c3 * (first * along);
    rough = first * ((Number(1) - k2) + mul_sub(k2 + k2, k2, k3));
    const Number rate = mul_add(rough, mul_add(rough, mul_add(rough, mul_add(rough, c5, c4), c3), c2), v);
    bend = rough * mul_add(rough, d.d3 * Number(0.5), a) * inverse;
    const Number less = Number(1) - bend;  // (1 - bend)(1 + bend^2), nearly 1/(1 + bend)
    correction = neg_mul_add(rough, rate, distance) * inverse * mul_add(less * bend, bend, less);
    time = rough + correction;
  }

  /// Whether the distance covered in this time is exact to 2^-52, in units of the time in which derivatives grow, if it
  /// is below 1/256 of that.
  [[nodiscard]] Mask<Number> converged() const {
    using std::abs;
    const Mask<Number> straight = abs(bend) <= Number(0x1p-5);
    return straight & (abs(correction) <= abs(rough) * Number(0x1p-20));
  }
};

/// The velocity a short time t later, by the Taylor series to the sixth derivative of the displacement.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Number velocity_after(const Number& t, const Number& v, const Number& a,
                                                               const HigherDerivatives<Number>& d) {
  const Number c6 = d.d6 * ratio<Number>(1, 120), c5 = d.d5 * ratio<Number>(1, 24);
  const Number c4 = d.d4 * ratio<Number>(1, 6), c3 = d.d3 * Number(0.5);
  return mul_add(t, mul_add(t, mul_add(t, mul_add(t, mul_add(t, c6, c5), c4), c3), a), v);
}

}  // namespace clatter::motion
