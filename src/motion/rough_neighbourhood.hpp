#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/first_crossing.hpp"
#include "motion/soft_neighbourhood.hpp"

namespace clatter::motion {

/// The same proof under dry friction: all motions from an ellipse turn back at the same places of their order, too.
///
/// Friction is a constant force as long as the velocity keeps its sign, so the difference of two slips to one side is a
/// free motion, and no other motion turns back as long as the observed speed is larger than the bound of the
/// difference. Where the observed one turns back, all do within a time |s| <= 2 d/|a| (eq. 75), and none sticks if the
/// other forces stay beyond the static level. Then their difference changes by eq. 64, with the remainder of eq. 76.
class RoughNeighbourhood : public SoftNeighbourhood {
 public:
  /// All motions within `start`, under friction with a static level.
  RoughNeighbourhood(const Stops& stops, const Ellipse& start, double rounding, double static_level, double rate = 1)
      : SoftNeighbourhood(stops, start, rounding, false, rate), static_level_(acceleration(static_level)) {}

  template <class A>
  void arc(const A& arc, double tau, double duration) {
    const double begin = now_;
    SoftNeighbourhood::arc(arc, tau, duration);
    forbid_jump(rate_ * duration);
    if (!holds_) return;
    keep_moving(arc, begin, now_ - begin);
    if (moving_from_ <= now_) least_bound_ = 0;
  }
  /// A stick forgets the speed, at an instant that changes with the start, and ends the proof as a rest does.
  void event(const Event& event) {
    if (event.kind == Event::Kind::reversal) return reverse(event);
    if (event.lasts() || all_move()) SoftNeighbourhood::event(event);
  }

  /// Whether the proof holds up to here; not while some of the motions may have turned back that others have not.
  [[nodiscard]] bool holds() const { return SoftNeighbourhood::holds() && !slows_ && moving_from_ <= now_; }

 private:
  void reverse(const Event& reversal) {
    if (!holds_) return;
    holds_ = slows_ && approached_ == Side::none && now_ >= std::max(clear_from_, moving_from_) &&
             turn(acceleration(reversal.a_before), acceleration(reversal.a_after));
    slows_ = false;
  }
  /// Whether no motion turns back about the time of another event, which is now.
  [[nodiscard]] bool all_move() {
    holds_ = holds_ && !slows_ && now_ >= moving_from_;
    moving_from_ = 0;
    return holds_;
  }

  /// Finds whether all speeds are larger than 0 for all of a slip, from the end of a reversal on, or until one may
  /// follow.
  template <class A>
  void keep_moving(const A& arc, double begin, double length) {
    const double sign = std::signbit(arc.constants().friction) ? 1 : -1;  // friction acts against the velocity
    const double from = std::max(0.0, moving_from_ - begin);
    if (slows_ || !(from < length)) return;
    const Motion<double> start = from > 0 ? arc.at(from / rate_) : arc.start();
    const Margin<double> speed{-rate_ * bound_, 0, sign};
    holds_ = speed.of(start) > 0;
    if (!holds_) return;
    const auto crossing =
        first_crossing(A(arc.constants(), start, arc.anchor()), std::array{speed}, (length - from) / rate_);
    holds_ = crossing.resolved;
    if (crossing.margin == 0) slows_ = true, slows_from_ = begin + from + rate_ * crossing.elapsed;
  }

  /// Takes the differences through a reversal, with these accelerations; false unless all motions turn back there,
  /// once, and at once.
  [[nodiscard]] bool turn(double a_before, double a_after) {
    const double before = std::abs(a_before), after = std::abs(a_after), least = std::min(before, after);
    const double jump = std::abs(a_after - a_before), push = (before + after) / 2;
    const double c = std::abs(field_.k) / field_.weight + 2 * field_.h;  // bounds a - a of the others, over the norm
    const double d = bound_, wait = 2 * d / before + clock_rounding();
    const LocalBounds near = field_.near(0, std::max(before, after), wait);
    const double off = near.jerk * wait + c * near.growth * d;
    const bool turns = off <= least / 2 && push - off > static_level_ && now_ - slows_from_ <= wait;
    if (!turns) return false;

    const double late = (first_order_.v() + remainder_.v() + rounding_) / (before - off);  // |time between|
    const double missed = (near.jerk * late / 2 + c * near.growth * d) * late;             // of v + a s = 0
    const double rest_v = jump * (missed / before + 2 * late * late * (2 * field_.h + std::abs(field_.k) * late)),
                 rest_x = jump * late * late;
    const Jacobian<double> saltation{1, 0, 0, a_after / a_before};
    first_order_ = first_order_.mapped(saltation), remainder_ = remainder_.mapped(saltation);
    remainder_.add(Ellipse(2 * rest_x * rest_x, 0, 2 * rest_v * rest_v));
    return move_on(near.growth * (d + norm(field_.weight * rest_x, rest_v)), after, before, wait);
  }
  /// Whether all motions then move back faster than their speeds differ, after a time that is no less than `wait`.
  [[nodiscard]] bool move_on(double d, double after, double before, double wait) {
    const double longer = std::max(wait, 4 * d / after);
    const LocalBounds away = field_.near(0, std::max(before, after), longer);
    const double c = std::abs(field_.k) / field_.weight + 2 * field_.h;
    restart();
    least_bound_ = d, moving_from_ = longer;
    begin_flight(std::max(reach_, d));
    return away.jerk * longer + c * away.growth * d <= after / 2;
  }

  double static_level_;
  double moving_from_ = 0;  ///< until then some of the motions may not have turned back yet
  bool slows_ = false;      ///< some of the motions may turn back from `slows_from_` on
  double slows_from_ = 0;
};

}  // namespace clatter::motion
