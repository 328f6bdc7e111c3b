#pragma once

#include "math/bernstein.hpp"

namespace clatter {
inline namespace math {

/// One step of Halley's method: the distance back to a root from a value, its slope and half its second derivative.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Number back_to_root(const Number& value, const Number& slope,
                                                             const Number& bend) {
  return value * slope / mul_sub(slope, slope, value * bend);
}

/// A polynomial of degree 5 by powers of the part t of a step: guesses for iterations on the motion itself.
template <class Number>
class Quintic {
 public:
  /// From its Bernstein coefficients, its degree raised to 6.
  [[gnu::always_inline]] explicit inline Quintic(Bernstein<Number> c) : c0_(c[0]) {
    for (std::size_t order = 1; order <= 5; ++order)
      for (std::size_t i = 6; i >= order; --i) c[i] = c[i] - c[i - 1];  // c[k] becomes the k-th difference at 0
    c1_ = c[1] * Number(6.0), c2_ = c[2] * Number(15.0), c3_ = c[3] * Number(20.0), c4_ = c[4] * Number(15.0);
    c5_ = c[5] * Number(6.0);
  }

  /// Value, slope and half the second derivative.
  struct Local {
    Number value, slope, bend;
  };
  [[nodiscard, gnu::always_inline]] inline Local at(const Number& t) const {
    const Number f1 = mul_add(c5_, t, c4_), f2 = mul_add(f1, t, c3_), f3 = mul_add(f2, t, c2_),
                 f4 = mul_add(f3, t, c1_);
    const Number s2 = mul_add(c5_, t, f1), s3 = mul_add(s2, t, f2), s4 = mul_add(s3, t, f3);
    const Number h3 = mul_add(c5_, t, s2), h4 = mul_add(h3, t, s3);
    return {mul_add(f4, t, c0_), mul_add(s4, t, f4), mul_add(h4, t, s4)};
  }

  /// The first root, from the first crossing `start` of the control polygon: by one step of Halley's method, or two for
  /// those wanted roots on the way to which the slope changes much.
  [[nodiscard, gnu::always_inline]] inline Number root(const Number& start, const Mask<Number>& wanted) const {
    const auto [value, slope, bend] = at(start);
    const Number back = back_to_root(value, slope, bend), near = start - back;
    using std::abs;
    const Mask<Number> far = wanted & (abs(back * bend) > abs(slope) * Number(0.1));
    if (!any(far)) return near;
    const Local closer = at(near);
    return select(far, near - back_to_root(closer.value, closer.slope, closer.bend), near);
  }

  /// The t of the least value, if that is between the ends: by Newton's iteration for the slope's root, from the least
  /// inner coefficient of the Bernstein form.
  [[nodiscard, gnu::always_inline]] inline Number least(const Bernstein<Number>& c) const {
    const auto at_sixth = [](double k) { return ratio<Number>(k, 6); };
    const Number left = select(c[1] < c[2], at_sixth(1), at_sixth(2)),
                 right = select(c[5] < c[4], at_sixth(5), at_sixth(4)), outer_low = lesser(c[1], c[2]),
                 outer_high = lesser(c[4], c[5]);
    Number t = select(c[3] < lesser(outer_low, outer_high), at_sixth(3), select(outer_low < outer_high, left, right));
    for (int i = 0; i < 3; ++i) {
      const Local l = at(t);
      t = neg_mul_add(Number(0.5), l.slope / l.bend, t);
    }
    return t;
  }

 private:
  Number c0_, c1_, c2_, c3_, c4_, c5_;
};

}  // namespace math
}  // namespace clatter
