#pragma once

#include "lanes/vector.hpp"

namespace clatter::lanes {

/// A function at both ends of an interval of time: value, and first and second derivative by time over its length.
template <class V>
struct HermiteData {
  V y0, v0, a0, y1, v1, a1;

  /// Converts derivatives by a time in which the interval has the length `length`.
  static HermiteData scaled(const HermiteData& e, const V& length) {
    const V square = length * length;
    return {e.y0, e.v0 * length, e.a0 * square, e.y1, e.v1 * length, e.a1 * square};
  }
};

template <class V>
struct Interval {
  V low, high;

  /// Keeps a NaN of its own, so that no comparison then proves anything: if an operand is NaN, min and max give the
  /// second one.
  void include(const V& y) { low = min(y, low), high = max(y, high); }
};

/// Interval of a function without its values at both ends: that of the inner Bernstein coefficients of its quintic
/// Hermite polynomial (eq. 12), the middle one widened by the error (eq. 13). NaN if any input is: the middle
/// coefficient depends on all of them, and stands second in min and max.
template <class V>
[[nodiscard, gnu::always_inline]] inline Interval<V> enclosure(const HermiteData<V>& e, const V& error) {
  const V b1 = fma(V(1.0 / 6), e.v0, e.y0), b2 = fma(V(1.0 / 30), e.a0, fma(V(1.0 / 3), e.v0, e.y0));
  const V b5 = fnma(V(1.0 / 6), e.v1, e.y1), b4 = fma(V(1.0 / 30), e.a1, fnma(V(1.0 / 3), e.v1, e.y1));
  const V b3 = fma(V(1.0 / 40), e.a0 + e.a1, fma(V(0.2), e.v0 - e.v1, (e.y0 + e.y1) * 0.5));
  return {min(min(min(b1, b2), min(b4, b5)), b3 - error), max(max(max(b1, b2), max(b4, b5)), b3 + error)};
}

/// The quintic Hermite polynomial itself, by powers of the part t of the interval.
template <class V>
class QuinticHermite {
 public:
  explicit QuinticHermite(const HermiteData<V>& e)
      : c0_(e.y0), c1_(e.v0), c2_(e.a0 * 0.5), y1_(e.y1), v1_(e.v1), half_a1_(e.a1 * 0.5) {
    const V D = y1_ - c0_;
    c3_ = fma(V(10.0), D, half_a1_ - fma(V(6.0), c1_, fma(V(4.0), v1_, c2_ * 3.0)));
    c4_ = fma(V(-15.0), D, fma(V(8.0), c1_, fma(V(7.0), v1_, fma(V(3.0), c2_, half_a1_ * -2.0))));
    c5_ = fma(V(6.0), D, half_a1_ - fma(V(3.0), c1_ + v1_, c2_));
  }

  /// Value, slope and half the second derivative.
  struct Local {
    V value, slope, bend;
  };
  [[nodiscard, gnu::always_inline]] Local at(const V& t) const {
    const V f1 = fma(c5_, t, c4_), f2 = fma(f1, t, c3_), f3 = fma(f2, t, c2_), f4 = fma(f3, t, c1_);
    const V s2 = fma(c5_, t, f1), s3 = fma(s2, t, f2), s4 = fma(s3, t, f3);
    const V h3 = fma(c5_, t, s2), h4 = fma(h3, t, s3);
    return {fma(f4, t, c0_), fma(s4, t, f4), fma(h4, t, s4)};
  }

  /// The t of its least value, if that is between the ends: by Newton's iteration for the slope's root, from the least
  /// inner point of the control polygon.
  [[nodiscard]] V least() const {
    const auto [b1, b2, b3, b4] = polygon();
    const V left = select(b1 < b2, V(0.2), V(0.4)), right = select(b4 < b3, V(0.8), V(0.6));
    V t = select(min(b1, b2) < min(b3, b4), left, right);
    for (int i = 0; i < 3; ++i) {
      const Local l = at(t);
      t = fnma(V(0.5), l.slope / l.bend, t);
    }
    return t;
  }
  /// The first root of a polynomial that begins positive: from the first crossing of its control polygon, by one step
  /// of Halley's method, or two for those wanted roots on the way to which the slope changes much.
  template <class Mask>
  [[nodiscard, gnu::always_inline]] V root(const Mask& wanted) const {
    const auto [b1, b2, b3, b4] = polygon();
    V before = b4, beyond = y1_, t(0.8);
    const auto consider = [&](const V& one, const V& next, double place) {
      const auto crosses = next < V(0.0);
      before = select(crosses, one, before), beyond = select(crosses, next, beyond), t = select(crosses, V(place), t);
    };
    consider(b3, b4, 0.6), consider(b2, b3, 0.4), consider(b1, b2, 0.2), consider(c0_, b1, 0.0);
    t = fma(V(0.2), before / (before - beyond), t);
    const auto back_to_root = [](const Local& l) {
      return l.value * l.slope / fms(l.slope, l.slope, l.value * l.bend);
    };
    const Local here = at(t);
    const V back = back_to_root(here);
    const Mask far = wanted & (beyond < V(0.0)) & (abs(back * here.bend) > abs(here.slope) * 0.1);
    t = t - back;
    return any(far) ? select(far, t - back_to_root(at(t)), t) : t;
  }

 private:
  /// The inner points of the control polygon, at 0.2 ... 0.8.
  struct Polygon {
    V b1, b2, b3, b4;
  };
  [[nodiscard, gnu::always_inline]] Polygon polygon() const {
    return {fma(V(0.2), c1_, c0_), fma(V(0.1), c2_, fma(V(0.4), c1_, c0_)),
            fma(V(0.1), half_a1_, fnma(V(0.4), v1_, y1_)), fnma(V(0.2), v1_, y1_)};
  }

  V c0_, c1_, c2_, c3_, c4_, c5_, y1_, v1_, half_a1_;
};

template <class V>
[[nodiscard]] V sixth_power(const V& y) {
  const V square = y * y;
  return square * square * square;
}

}  // namespace clatter::lanes
