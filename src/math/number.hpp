#pragma once

#include <cmath>
#include <limits>

namespace clatter {
inline namespace math {

/// pi, correctly rounded in each number type.
template <class Number>
[[nodiscard]] const Number& pi() {
  using std::atan;
  static const Number value = 4 * atan(Number(1));
  return value;
}

/// The distance from 1 to the next number.
template <class Number>
[[nodiscard]] Number epsilon() {
  return std::numeric_limits<Number>::epsilon();
}

/// A number type that carries derivatives.
template <class Number>
concept CarriesDerivatives = requires(const Number& y) {
  y.is_constant();
};

/// Whether a number is finite, whatever its derivatives.
template <class Number>
[[nodiscard]] bool is_finite(const Number& number) {
  return std::isfinite(static_cast<double>(number));
}

/// Whether a number is 0 and, if it carries derivatives, they are 0, too.
template <class Number>
[[nodiscard]] constexpr bool is_always_zero(const Number& y) {
  if constexpr (CarriesDerivatives<Number>) return is_always_zero(y.value) && y.is_constant();
  return y == 0;
}

/// a if the mask holds, else b; for SIMD vectors it replaces a branch.
template <class Number>
[[nodiscard]] Number select(bool mask, const Number& a, const Number& b) {
  return mask ? a : b;
}

// All that the physics is made of, besides + - * / and comparisons: the same source runs for double, for 50 digits and
// for SIMD vectors, which bring their own versions of these (lanes/vector.hpp).

/// The result of a comparison: bool, or a mask with a bit for each element of a vector.
template <class Number>
struct MaskOf {
  using type = bool;
};
template <class Number>
using Mask = typename MaskOf<Number>::type;
/// Whether the comparison holds; for a mask, for any element.
[[nodiscard]] inline bool any(bool mask) { return mask; }

/// x y + z, in one rounding for vectors whose instruction set can do so.
template <class Number>
[[nodiscard]] Number mul_add(const Number& x, const Number& y, const Number& z) {
  return x * y + z;
}
/// x y - z
template <class Number>
[[nodiscard]] Number mul_sub(const Number& x, const Number& y, const Number& z) {
  return x * y - z;
}
/// z - x y
template <class Number>
[[nodiscard]] Number neg_mul_add(const Number& x, const Number& y, const Number& z) {
  return z - x * y;
}

/// The lesser of two numbers; the second one if either is NaN, as in vectors.
template <class Number>
[[nodiscard]] Number lesser(const Number& x, const Number& y) {
  return x < y ? x : y;
}
/// The greater of two numbers; the second one if either is NaN.
template <class Number>
[[nodiscard]] Number greater(const Number& x, const Number& y) {
  return x > y ? x : y;
}

/// p/q, correctly rounded in each number type.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Number ratio(double p, double q) {
  if constexpr (requires { typename Number::Batch; })
    return Number(p / q);
  else
    return Number(p) / Number(q);
}

/// (x^2 + y^2)^(1/2), also if the squares would overflow or vanish.
template <class Number>
[[nodiscard]] Number norm(const Number& x, const Number& y) {
  using std::abs, std::sqrt;
  const bool first = abs(x) > abs(y);  // one comparison for both, so that a NaN on either side stays
  const Number large = first ? abs(x) : abs(y), small = first ? abs(y) : abs(x);
  if (large == 0) return small;
  const Number ratio = small / large;
  return large * sqrt(1 + ratio * ratio);
}

/// Sine and cosine of one angle.
template <class Number>
struct SineCosine {
  Number sine, cosine;
};

/// Sine and cosine of an angle given in turns: exact at every quarter turn, odd and even to the last bit.
template <class Number>
[[nodiscard]] SineCosine<Number> sine_cosine_of_turns(const Number& turns) {
  using std::cos, std::floor, std::sin;
  if (is_always_zero(turns)) return {turns, Number(1)};  // each section, if the start has no phase
  const Number quarters = floor(4 * turns + Number(0.5));
  const Number angle = 2 * pi<Number>() * (turns - quarters / 4);  // exact difference, |angle| <= pi/4
  const Number s = sin(angle), c = cos(angle);
  const int quadrant = static_cast<int>(quarters - 4 * floor(quarters / 4));
  if (quadrant == 0) return {s, c};
  if (quadrant == 1) return {c, -s};
  if (quadrant == 2) return {-s, -c};
  return {-c, s};
}

/// An angle in turns, -1/2 ... 1/2: by sine and cosine, so that no digit of it is lost, however large it is.
template <class Number>
[[nodiscard]] Number turns_of(const Number& angle) {
  using std::atan2, std::cos, std::sin;
  if (is_always_zero(angle)) return angle;  // the phase of most starts
  return atan2(Number(sin(angle)), Number(cos(angle))) / (2 * pi<Number>());
}

/// The part of a turn of an angle in turns, in [0, 1).
template <class Number>
[[nodiscard]] Number part_of_turn(const Number& turns) {
  using std::floor;
  const Number part = turns - floor(turns);
  return part == 1 ? Number(0) : part;  // rounded up
}

}  // namespace math
}  // namespace clatter
