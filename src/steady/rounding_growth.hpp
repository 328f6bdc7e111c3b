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
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    const bool arrives = event.kind == Kind::impact || event.kind == Kind::touch || event.kind == Kind::renewal;
    if (event.kind == Kind::rest) error_ = {};
    if (!arrives && event.kind != Kind::stick && event.kind != Kind::reversal) return;
    tangent_.event(event);
    if (arrives)  // with an error of time that is larger the slower it arrives
      lateness_ = std::abs((event.place - from_) / event.before), from_ = event.place;
    take();
  }
  /// Adds an error of time, in units of epsilon.
  void delay(double time) { lateness_ += time; }

  /// The largest error up to now, relative to the size of the motion.
  [[nodiscard]] double largest() const { return largest_ > 0 ? largest_ / size_ : 0.0; }

 private:
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
