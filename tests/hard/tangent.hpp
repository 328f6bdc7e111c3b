#pragma once

#include <array>
#include <cmath>

#include "dynamics/arc.hpp"

namespace clatter::hard {

/// A map of small changes (dx, dv), by rows.
template <class Number>
using Map = std::array<Number, 4>;

/// The derivative of a motion by its start: free motion over the arcs, and at each impact its saltation matrix
/// (physics.md, check 5). Kept as a rotation times a triangle, so that its determinant keeps its digits however far the
/// two multipliers are apart. Rests have no such derivative.
template <class Number>
class Tangent {
 public:
  template <Effects E>
  void arc(const Arc<Number, E>& arc, double, double length) {
    const auto p = arc.flow().propagator(Number(length));
    multiply({p.a, p.b, -p.b, p.c});
    h_ = arc.flow().h,
    force_ = arc.flow().load + arc.flow().acceleration(Number(0), Number(0), arc.at(Number(length)).sine);
  }
  void rest(const Rest&) {}
  void impact(const Impact& impact) {
    const Number before(impact.before), after(impact.after), R = -after / before;
    const Number a_before = force_ - impact.place - 2 * h_ * before, a_after = force_ - impact.place - 2 * h_ * after;
    multiply({-R, Number(0), (R * a_before + a_after) / before, -R});
  }

  [[nodiscard]] Map<Number> map() const {
    return {cosine_ * top_, cosine_ * shear_ - sine_ * bottom_, sine_ * top_, sine_ * shear_ + cosine_ * bottom_};
  }
  [[nodiscard]] Number determinant() const { return top_ * bottom_; }

 private:
  /// Puts a map after this one: its effect on the two turned directions is turned upright again.
  void multiply(const Map<Number>& f) {
    const Number x = f[0] * cosine_ + f[1] * sine_, v = f[2] * cosine_ + f[3] * sine_;
    const Number side_x = f[1] * cosine_ - f[0] * sine_, side_v = f[3] * cosine_ - f[2] * sine_;
    const Number length = norm(x, v);
    const Number area = f[0] * f[3] - f[1] * f[2];  // of a strong shear: no difference of large numbers
    if (length > 0) cosine_ = x / length, sine_ = v / length;
    top_ *= length;
    shear_ = length * shear_ + (cosine_ * side_x + sine_ * side_v) * bottom_;
    bottom_ *= length > 0 ? Number(area / length) : Number(cosine_ * side_v - sine_ * side_x);
  }

  Number cosine_ = 1, sine_ = 0;             ///< the rotation
  Number top_ = 1, shear_ = 0, bottom_ = 1;  ///< the triangle
  Number h_ = 0, force_ = 0;                 ///< damping, and the force at the end of the last arc
};

}  // namespace clatter::hard
