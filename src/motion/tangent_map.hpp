#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/arc.hpp"
#include "motion/contact_force.hpp"
#include "motion/event.hpp"
#include "motion/perturbation.hpp"

namespace clatter::motion {

/// The derivative of a motion with respect to its start: free motion over the arcs (eq. 7), the saltation matrix at
/// each impact (eqs. 27 and 87; Nordmark 1991) and each reversal of a slip (eq. 64), 0 after a rest; of a stick the
/// place is left. Kept as a rotation times a triangle, so that the determinant (eq. 28) keeps its digits however far
/// apart the multipliers are, times a power of two, so that nothing overflows.
template <class Number>
class TangentMap {
 public:
  explicit TangentMap(const Stops& stops) : stops_(stops) {}

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto& constants = arc.constants();
    if (std::exchange(sticks_, false)) release(arc);
    multiply(power_of(constants, Number(length)));
    friction_ = constants.friction;
    h_ = constants.h, k_ = constants.k, force_ = constants.force(arc.phase_after(Number(length)));
  }
  void event(const Event& event) {
    using Kind = Event::Kind;
    if (event.kind == Kind::impact) rebound(event);
    if (event.kind == Kind::touch) touch(event.side);
    if (event.kind == Kind::reversal)  // the acceleration jumps where the velocity is 0
      scale_velocity(Number(event.a_after) / Number(event.a_before));
    if (event.kind == Kind::rest || event.kind == Kind::chatter) top_ = shear_ = bottom_ = 0, sticks_ = false;
    if (event.kind == Kind::stick) scale_velocity(Number(0)), sticks_ = true;
  }

  /// Makes the map that of the motion from here on.
  void begin_anew() { cosine_ = 1, sine_ = 0, top_ = 1, shear_ = 0, bottom_ = 1, exponent_ = 0; }

  [[nodiscard]] Jacobian<Number> map() const {
    Jacobian<Number> map = mantissa();
    for (Number& entry : map) entry = scaled(entry, exponent_);
    return map;
  }
  [[nodiscard]] Number determinant() const { return scaled(mantissa_determinant(), 2 * exponent_); }

  /// The map without its power of two, for uses that would over- or underflow with it.
  [[nodiscard]] Jacobian<Number> mantissa() const {
    return {cosine_ * top_, cosine_ * shear_ - sine_ * bottom_, sine_ * top_, sine_ * shear_ + cosine_ * bottom_};
  }
  [[nodiscard]] Number mantissa_determinant() const { return top_ * bottom_; }
  [[nodiscard]] double exponent() const { return exponent_; }  ///< of two, a whole number

  /// y 2^exponent, 0 or infinite beyond the range of the number.
  [[nodiscard]] static Number scaled(const Number& y, double exponent) {
    using std::ldexp;
    constexpr double most = 1 << 20;
    return ldexp(y, static_cast<int>(std::clamp(exponent, -most, most)));
  }

  /// Logarithm of the largest factor by which the map stretches a change; -inf if the map is 0.
  [[nodiscard]] Number log_norm() const {
    using std::abs, std::log, std::sqrt;
    const Number sum = top_ * top_ + shear_ * shear_ + bottom_ * bottom_, area = 2 * abs(top_ * bottom_);
    return log((sqrt(sum + area) + sqrt(select<Number>(sum > area, Number(sum - area), Number(0)))) / 2) +
           Number(exponent_) * log(Number(2));
  }

 private:
  void rebound(const Event& impact) {
    const Number before(impact.before), after(impact.after);
    if (before == 0) return;  // it touches, and the velocity is not reversed
    const Restitution<Number> law = restitution_at<Number>(stops_, impact.side);
    const Number ratio = -law.share(before), slope = law.derivative(before), carried(impact.stop.velocity),
                 force = force_ - k_ * impact.place - impact.stop.acceleration;
    const Number a_before = force - 2 * h_ * (before + carried),
                 a_after = force - 2 * friction_ - 2 * h_ * (after + carried);
    multiply({{ratio, Number(0), (a_after - slope * a_before) / before, slope}, ratio * slope});
  }
  /// The damper of a soft stop pushes from the touch on, so the acceleration jumps (eq. 53); where the mass leaves the
  /// stop nothing does.
  void touch(Side side) {
    const Number slower = -2 * soft_stop_at<Number>(stops_, side).damping;
    multiply({{Number(1), Number(0), slower, Number(1)}, Number(1)});
  }
  void scale_velocity(const Number& factor) { multiply({{Number(1), Number(0), Number(0), factor}, factor}); }
  /// A stick ends the later the further the spring has to be overcome: by k dx/(f nu cos theta) (eq. 65).
  template <class A>
  void release(const A& arc) {
    const auto& constants = arc.constants();
    const auto& start = arc.start();
    const Number later = constants.spring(Number(1)) / (constants.f * constants.nu * constants.drive(start).cosine);
    if (start.a != 0 && !constants.is_let_go_by_jump(start))
      multiply({{Number(1), Number(0), -start.a * later, Number(1)}, Number(1)});
  }

  /// A map times 2^exponent, with its determinant kept apart.
  struct ScaledMap {
    Jacobian<Number> map;
    Number determinant;
    double exponent = 0;

    /// Brings the entries near to 1.
    void rescale() {
      using std::abs, std::ldexp, std::max;
      const Number size = max(max(abs(map[0]), abs(map[1])), max(abs(map[2]), abs(map[3])));
      const int shift =
          size > 0 && std::isfinite(static_cast<double>(size)) ? std::ilogb(static_cast<double>(size)) : 0;
      for (Number& entry : map) entry = ldexp(entry, -shift);
      determinant = ldexp(determinant, -2 * shift), exponent += shift;
    }
  };

  /// Free motion over a time of any length, as a power of one over a time so short that it doesn't underflow.
  template <class ArcConstants>
  [[nodiscard]] static ScaledMap power_of(const ArcConstants& constants, const Number& length) {
    using std::abs, std::exp;
    int doublings = 0;
    Number piece = length;
    const Number slower = constants.rotates() ? constants.h : Number(abs(constants.slow));  // the faster may vanish
    for (; slower * piece > 64; ++doublings) piece /= 2;
    const auto p = constants.propagator(piece);
    ScaledMap power{{p.a, p.b, -constants.spring(p.b), p.c}, exp(-2 * constants.h * piece)};
    for (; doublings > 0; --doublings) {
      const auto [a, b, c, d] = power.map;
      power.map = {a * a + b * c, b * (a + d), c * (a + d), b * c + d * d};
      power.determinant *= power.determinant, power.exponent *= 2;
      power.rescale();
    }
    return power;
  }

  /// Multiplies the map by a `factor` from the left, and makes the product a rotation times a triangle again.
  void multiply(const ScaledMap& factor) {
    using std::abs, std::ldexp;
    const Jacobian<Number>& f = factor.map;
    const Number x = f[0] * cosine_ + f[1] * sine_, v = f[2] * cosine_ + f[3] * sine_;
    const Number side_x = f[1] * cosine_ - f[0] * sine_, side_v = f[3] * cosine_ - f[2] * sine_;
    const Number length = norm(x, v);
    if (length > 0) cosine_ = x / length, sine_ = v / length;
    top_ *= length;
    shear_ = length * shear_ + (cosine_ * side_x + sine_ * side_v) * bottom_;
    bottom_ *= length > 0 ? Number(factor.determinant / length) : Number(cosine_ * side_v - sine_ * side_x);
    exponent_ += factor.exponent;
    const Number size = abs(top_) + abs(shear_) + abs(bottom_), far = ldexp(Number(1), 256);
    const int shift = size > far ? -256 : size > 0 && size < 1 / far ? 256 : 0;
    if (shift == 0) return;
    for (Number* const entry : {&top_, &shear_, &bottom_}) *entry = ldexp(*entry, shift);
    exponent_ -= shift;
  }

  Stops stops_;
  Number cosine_ = 1, sine_ = 0;             ///< the rotation
  Number top_ = 1, shear_ = 0, bottom_ = 1;  ///< the triangle,
  double exponent_ = 0;                      ///< times 2^exponent
  Number h_ = 0, k_ = 1, force_ = 0;         ///< damping, stiffness, and the force at the end of the last arc,
  Number friction_ = 0;                      ///< of which so much is friction
  bool sticks_ = false;                      ///< friction has held the mass since
};

}  // namespace clatter::motion
