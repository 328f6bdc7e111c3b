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

/// a if the mask holds, else b; for SIMD vectors it replaces a branch.
template <class Number>
[[nodiscard]] Number select(bool mask, const Number& a, const Number& b) {
  return mask ? a : b;
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
  const Number quarters = floor(4 * turns + Number(0.5));
  const Number angle = 2 * pi<Number>() * (turns - quarters / 4);  // exact difference, |angle| <= pi/4
  const Number s = sin(angle), c = cos(angle);
  const int quadrant = static_cast<int>(quarters - 4 * floor(quarters / 4));
  if (quadrant == 0) return {s, c};
  if (quadrant == 1) return {c, -s};
  if (quadrant == 2) return {-s, -c};
  return {-c, s};
}

}  // namespace math
}  // namespace clatter
