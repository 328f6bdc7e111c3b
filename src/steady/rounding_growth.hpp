#pragma once

#include <algorithm>
#include <cmath>

#include "motion/ellipse.hpp"
#include "motion/tangent_map.hpp"

namespace clatter::steady {

/// How far rounding may carry a computed motion from the true one, in units of the epsilon of its numbers: every flight
/// adds an error of its speed, and of its time, and the motion stretches them all as it stretches small changes
/// (eq. 27). A rest erases them.
class RoundingGrowth {
 public:
  explicit RoundingGrowth(const Stops& stops) : tangent_(stops) {}

  template <class A>
  void arc(const A& arc, double, double length) {
    const double v = arc.start().v, a = arc.start().a, late = lateness_ + arc.constants().period;
    error_.add({late * late * v * v, late * late * v * a, late * late * a * a});
    error_.add({0, 0, v * v});
    lateness_ = 0;
    tangent_.arc(arc, 0.0, length);
    size_ = std::max({size_, std::abs(arc.start().x), std::abs(v)});
    take();
  }
  void rest(const motion::Rest& rest) {
    if (rest.held && !rest.is_stick()) error_ = {};
    if (rest.is_stick()) tangent_.rest(rest), take();
  }
  void reversal(const motion::Reversal& reversal) { tangent_.reversal(reversal), take(); }
  /// Adds an error of time, in units of epsilon.
  void delay(double time) { lateness_ += time; }
  void impact(const motion::Impact& impact) {
    tangent_.impact(impact);
    arrive(impact.position, impact.before);
  }
  void touch(const motion::Touch& touch) {
    tangent_.touch(touch);
    arrive(touch.position, touch.velocity);
  }

  /// The largest error up to now, relative to the size of the motion.
  [[nodiscard]] double largest() const { return largest_ > 0 ? largest_ / size_ : 0.0; }

 private:
  /// A flight ends at a position, with an error of time that is larger the slower it arrives.
  void arrive(double position, double velocity) {
    lateness_ = std::abs((position - from_) / velocity), from_ = position;
    take();
  }
  /// Carries the errors on over what `tangent_` has seen since it last was done.
  void take() {
    error_ = error_.mapped(tangent_.map());
    tangent_.begin_anew();
    largest_ = std::max(largest_, error_.size());
  }

  motion::TangentMap<double> tangent_;  ///< since the errors were last carried on
  motion::Ellipse error_{};             ///< of the present state
  double lateness_ = 0.0, from_ = 0.0;  ///< of the last impact; its position
  double largest_ = 0.0, size_ = 0.0;
};

}  // namespace clatter::steady
