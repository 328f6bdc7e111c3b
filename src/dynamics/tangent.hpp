#pragma once

#include <array>
#include <cmath>

#include "dynamics/arc.hpp"
#include "dynamics/impact.hpp"

namespace clatter {

/// A linear map of small changes (dx, dv), by rows.
template <class Number>
using Map = std::array<Number, 4>;

/// The derivative of a motion by its start: free motion over the arcs; at each impact its saltation matrix
/// S = [[-R, 0], [(R a- + a+)/v-, -R]] (physics: the impact comes earlier or later; Nordmark 1991); nothing is left of
/// a change after a rest. Kept as a rotation times a triangle, so that its determinant keeps its digits however far the
/// two multipliers are apart, times a power of two, so that it can't overflow.
template <class Number>
class Tangent {
 public:
  explicit Tangent(const Stops& stops) : stops_(stops) {}

  template <Effects E>
  void arc(const Arc<Number, E>& arc, double, double length) {
    using std::exp;
    const auto& flow = arc.flow();
    const double pieces = 1 + std::floor(static_cast<double>(flow.h) * length / 64);  // none of which underflows
    const Number piece = Number(length) / pieces, area = exp(-2 * flow.h * piece);
    const auto p = flow.propagator(piece);
    for (double i = 0; i < pieces; i += 1) multiply({p.a, p.b, -p.b, p.c}, area);
    h_ = flow.h, force_ = flow.load + flow.acceleration(Number(0), Number(0), arc.phase_after(Number(length)).sine);
  }
  void rest(const Rest&) { top_ = shear_ = bottom_ = 0; }
  void impact(const Impact& impact) {
    const Number before(impact.before), after(impact.after), R = stop_at<Number>(stops_, impact.side).restitution;
    const Number a_before = force_ - impact.place - 2 * h_ * before, a_after = force_ - impact.place - 2 * h_ * after;
    multiply({-R, Number(0), (R * a_before + a_after) / before, -R}, Number(R * R));
  }

  [[nodiscard]] Map<Number> map() const {
    using std::ldexp;
    Map<Number> map = mantissa();
    for (Number& entry : map) entry = ldexp(entry, exponent_);
    return map;
  }
  [[nodiscard]] Number determinant() const {
    using std::ldexp;
    return ldexp(mantissa_determinant(), 2 * exponent_);
  }

  /// The map without its power of two, for what would over- or underflow with it.
  [[nodiscard]] Map<Number> mantissa() const {
    return {cosine_ * top_, cosine_ * shear_ - sine_ * bottom_, sine_ * top_, sine_ * shear_ + cosine_ * bottom_};
  }
  [[nodiscard]] Number mantissa_determinant() const { return top_ * bottom_; }
  [[nodiscard]] int exponent() const { return exponent_; }  ///< of two

  /// Logarithm of the largest factor by which it stretches a change; -inf where nothing is left of any.
  [[nodiscard]] Number log_norm() const {
    using std::abs, std::log, std::sqrt;
    const Number sum = top_ * top_ + shear_ * shear_ + bottom_ * bottom_, area = 2 * abs(top_ * bottom_);
    return log((sqrt(sum + area) + sqrt(select<Number>(sum > area, Number(sum - area), Number(0)))) / 2) +
           exponent_ * log(Number(2));
  }

 private:
  static constexpr int step = 256;  ///< of the exponent

  /// Puts a map of this determinant after this one: its effect on the two turned directions is turned upright again.
  void multiply(const Map<Number>& f, const Number& area) {
    const Number x = f[0] * cosine_ + f[1] * sine_, v = f[2] * cosine_ + f[3] * sine_;
    const Number side_x = f[1] * cosine_ - f[0] * sine_, side_v = f[3] * cosine_ - f[2] * sine_;
    const Number length = norm(x, v);
    if (length > 0) cosine_ = x / length, sine_ = v / length;
    top_ *= length;
    shear_ = length * shear_ + (cosine_ * side_x + sine_ * side_v) * bottom_;
    bottom_ *= length > 0 ? Number(area / length) : Number(cosine_ * side_v - sine_ * side_x);
    rescale();
  }

  void rescale() {
    using std::abs, std::ldexp;
    const Number size = abs(top_) + abs(shear_) + abs(bottom_), far = ldexp(Number(1), step);
    const int shift = size > far ? -step : size > 0 && size < 1 / far ? step : 0;
    if (shift == 0) return;
    const Number scale = ldexp(Number(1), shift);
    top_ *= scale, shear_ *= scale, bottom_ *= scale, exponent_ -= shift;
  }

  Stops stops_;
  Number cosine_ = 1, sine_ = 0;             ///< the rotation
  Number top_ = 1, shear_ = 0, bottom_ = 1;  ///< the triangle,
  int exponent_ = 0;                         ///< times 2^exponent
  Number h_ = 0, force_ = 0;                 ///< damping, and the force at the end of the last arc
};

}  // namespace clatter
