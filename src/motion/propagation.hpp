#pragma once

#include <cmath>

#include "math/number.hpp"

namespace clatter::motion {

// How the two parts of a motion advance, for every number type: scalars, 50 digits, SIMD vectors.

/// The transient's part of a motion.
template <class Number>
struct FreeMotion {
  Number x, v;
};

/// Free motion over a time s (eq. 7): x(s) = A x + B v, v(s) = -k B x + C v, and its acceleration -k C x - D v.
template <class Number>
struct Propagator {
  Number a, b, c, d;
  Number a_minus_one;  ///< A - 1, small for short times

  /// With k = 1.
  [[nodiscard]] FreeMotion<Number> advance(const FreeMotion<Number>& from) const {
    return {mul_add(a, from.x, b * from.v), mul_sub(c, from.v, b * from.x)};
  }
};

/// Sine of an angle, and its cosine less 1.
template <class Number>
struct Turn {
  Number sine{}, cosine_minus_one{};
};

/// A turn by an angle, without cancellation if it is small.
template <class Number>
[[nodiscard]] Turn<Number> turn_by(const Number& angle) {
  using std::cos, std::sin;
  const Number half = sin(angle / 2);
  return {2 * half * cos(angle / 2), -2 * half * half};
}

/// Change of a phase's sine and cosine by a turn.
template <class Number>
[[nodiscard]] SineCosine<Number> change_by(const Turn<Number>& turn, const SineCosine<Number>& from) {
  return {mul_add(from.sine, turn.cosine_minus_one, from.cosine * turn.sine),
          mul_sub(from.cosine, turn.cosine_minus_one, from.sine * turn.sine)};
}

/// A phase after a turn.
template <class Number>
[[nodiscard]] SineCosine<Number> turned(const SineCosine<Number>& from, const Turn<Number>& turn) {
  const SineCosine<Number> change = change_by(turn, from);
  return {from.sine + change.sine, from.cosine + change.cosine};
}

/// The coefficients that advance every motion of an oscillator by a time s.
template <class Number>
struct Step {
  Propagator<Number> free;
  Turn<Number> turn{};                            ///< by nu s
  SineCosine<Number> displacement{}, velocity{};  ///< secular: response from rest to a unit force (eq. 11)
  Number fast_decay{};                            ///< heavy damping: e^(-fast s)
  Number pulled{};                                ///< displacement from rest under a unit force that no spring balances
};

/// The propagator of light damping at k = 1 over a time s (eq. 8), from e^(-h s), cos(lambda s), sin(lambda s)/lambda
/// and h.
template <class Number>
[[nodiscard]] Propagator<Number> light_propagator(const Number& decay, const Number& cosine,
                                                  const Number& sine_over_root, const Number& h) {
  const Number c = decay * cosine, b = decay * sine_over_root, v = neg_mul_add(h, b, c);
  return {mul_add(h, b, c), b, v, mul_add(h + h, v, b), {}};
}

}  // namespace clatter::motion
