#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "motion/first_crossing.hpp"
#include "motion/neighbourhood.hpp"
#include "motion/soft_stop.hpp"

namespace clatter::motion {

/// The same proof between stops of which some are soft: all motions from an ellipse touch, leave and touch again the
/// same stops in the same order.
///
/// In contact, and beyond a stop without contact, the difference of two motions is a free motion of the present
/// oscillator, too (eq. 57), so the margin that is to stay positive does so for all if the observed one's is larger
/// than the bound of the difference. Where the oscillator changes, all motions cross the same surface (eq. 59), and
/// their difference changes by eq. 58, whose second order is bounded by eq. 60.
class SoftNeighbourhood : public Neighbourhood {
 public:
  using Neighbourhood::Neighbourhood;

  template <class A>
  void arc(const A& arc, double tau, double duration) {
    if (!holds_) return;
    const Side pressing = arc.constants().stop.side, around = pressing != Side::none ? pressing : beyond(arc.start());
    if (around != Side::none) return within(arc, duration, around, pressing != Side::none ? contact : outrun);
    if (!begun_ && beside_soft_stop(arc.start())) return refuse();
    if (mode_ != outside && mode_ != unknown) leave(arc);
    mode_ = outside;
    Neighbourhood::arc(arc, tau, duration);
    if (has_soft_stop(stops_)) forbid_jump(rate_ * duration);
    holds_ = holds_ && (!leaving_ || stays_left());
    last_ = in_units(arc.at(duration)), bound_ = reach_;
  }
  void event(const Event& event) {
    using Kind = Event::Kind;
    if (event.kind == Kind::touch) return pass(event, outside, contact);
    if (event.kind == Kind::renewal) return pass(event, outrun, contact);
    if (event.kind == Kind::separation) return pass(event, contact, outrun);
    if (event.kind == Kind::impact) leaving_ = false;
    Neighbourhood::event(event);
  }

  /// Whether the proof holds up to here; not while some of the motions may have had an event that others have not.
  [[nodiscard]] bool holds() const { return Neighbourhood::holds() && clear_from_ <= now_; }

 protected:
  /// Ends the proof at an arc that begins with a jump of the force, of which soft contacts and reversals have no
  /// bounds.
  void forbid_jump(double length) { holds_ = holds_ && since_jump_ > length; }

  /// Where the mass is: between the stops, in contact with a soft one, or beyond its position without contact.
  enum Mode : std::uint8_t { unknown, outside, contact, outrun };

  void refuse() { holds_ = false; }

  /// Takes the differences through an event of a soft stop, at which the mass changes from one mode to another.
  void pass(const Event& event, Mode from, Mode to) {
    if (!holds_) return;
    if (to == contact) stop_ = soft_stop_at<double>(stops_, event.side), leaving_ = false;
    holds_ = std::exchange(mode_, to) == from && approached_ == event.side && cross(event.before / rate_, from);
  }

  /// The soft stop beyond whose position the mass is.
  [[nodiscard]] Side beyond(const Motion<double>& m) const {
    for (const Side side : {Side::lower, Side::upper})
      if (is_soft(stops_, side) && stop_at<double>(stops_, side).into(m.x - stop_at<double>(stops_, side).position) > 0)
        return side;
    return Side::none;
  }
  /// Whether a motion begins so near a soft stop that others may begin beyond it.
  [[nodiscard]] bool beside_soft_stop(const Motion<double>& start) const {
    return (is_soft(stops_, Side::lower) && std::abs(start.x - stops_.lower) <= reach_) ||
           (is_soft(stops_, Side::upper) && std::abs(start.x - stops_.upper) <= reach_);
  }

  /// Takes the differences over an arc beyond a soft stop's position, with `mode` contact or outrun.
  template <class A>
  void within(const A& arc, double duration, Side side, Mode mode) {
    const auto& constants = arc.constants();
    const double length = rate_ * duration, begin = std::exchange(now_, now_ + length);
    field_ = mode == contact ? in_its_norm(Field::of(constants, rate_)) : Field::of(constants, rate_);
    note_jump(arc, duration);
    forbid_jump(length);
    stop_ = soft_stop_at<double>(stops_, side);
    const double size = std::max(least_bound_, size_in(field_)) * field_.growth(length);
    bound_ = approached_ == Side::none ? size : std::max(bound_, size);
    begun_ = true;
    if (mode_ == unknown) {
      mode_ = mode;  // all begin in contact if the depth is clear of 0, too
      holds_ = mode == outrun || stop_.into(arc.start().x - stop_.position) > bound_ / field_.weight;
    }
    holds_ = holds_ && mode_ == mode && bound_ / field_.weight < stops_.upper - stops_.lower;  // none meets the other
    const double from = std::max(0.0, clear_from_ - begin);
    if (holds_ && approached_ == Side::none && from < length) keep_margin(arc, begin, from, length);
    last_ = in_units(arc.at(duration));
    advance(constants, duration);
  }

  /// Finds whether the stop's force keeps its sign for all, from the time `from` of this arc on, or comes near 0.
  template <class A>
  void keep_margin(const A& arc, double begin, double from, double length) {
    const double one = stop_.into(mode_ == contact ? 1.0 : -1.0), relaxation = stop_.relaxation();
    const Margin<double> margin{0.0, one, one * relaxation / rate_};
    const double less = one * bound_ * norm(1 / field_.weight, relaxation);
    Motion<double> start = from > 0 ? arc.at(from / rate_) : arc.start();
    start.offset -= less;  // the margin less the bound is that of a stop a little farther away
    holds_ = margin.of(start) > 0;
    if (!holds_) return;
    const auto crossing =
        first_crossing(A(arc.constants(), start, arc.anchor() + less), std::array{margin}, (length - from) / rate_);
    holds_ = crossing.resolved;
    if (crossing.margin == 0) approached_ = stop_.side, approached_at_ = begin + from + rate_ * crossing.elapsed;
  }

  /// The instant at which the observed motion crosses a surface g = depth + q depth' = 0, and its motion there.
  struct Passage {
    double q, rate;  ///< rate > 0: |g'|
    double speed, acceleration;
  };
  /// The least rate at which all motions within `bound` of the observed one cross it, up to a time `wait` from there.
  [[nodiscard]] static double least_rate(const Passage& at, const Field& field, double bound, double wait) {
    const LocalBounds near = field.near(at.speed, at.acceleration, wait);
    const double of_others = norm(1 - 2 * field.h * at.q, at.q * field.k / field.weight) * bound;
    return at.rate - (near.acceleration + at.q * near.jerk) * wait - near.growth * of_others;
  }

  /// Takes the differences to the other oscillator; false unless all motions cross the surface between the two once,
  /// and for good (eq. 59).
  [[nodiscard]] bool cross(double velocity, Mode from) {
    const double v = stop_.into(velocity), a = stop_.into(last_.a), q = from == outside ? 0 : stop_.relaxation();
    const double rate = (v + q * a) * (from == contact ? -1 : 1);
    const Passage before{q, rate, std::abs(v), std::abs(a)};
    const double wait = 2 * bound_ * norm(1 / field_.weight, q) / rate + clock_rounding(),
                 least = least_rate(before, field_, bound_, wait);
    if (!(rate > 0 && least >= rate / 2 && now_ >= clear_from_ && now_ - approached_at_ <= wait)) return false;
    const double s = change(q) / least, most = 2 * rate - least;  // |time between|, the largest rate
    if (!(s <= wait && (from != outrun || stays_beyond(before, wait, s)))) return false;
    const double jump = from == outside ? 2 * stop_.damping : 0;  // of the force over the rate, as the stop is touched
    field_ = across(from);
    if (!take_through(jump, most, s)) return false;
    const Passage after{q, rate, std::abs(v), std::abs(a - jump * v)};
    const double bound = size_in(field_);
    double longer = std::max(wait, 3 * bound * norm(1 / field_.weight, q) / rate);
    if (from == contact) longer = std::max(longer, leaving_time(before.speed));
    restart();
    approached_ = Side::none, clear_from_ = longer;
    return field_.near(after.speed, after.acceleration, longer).growth <= 1.5 &&
           least_rate(after, field_, bound, longer) >= rate / 2;
  }

  /// The oscillator on the other side of the surface.
  [[nodiscard]] Field across(Mode from) const {
    const double sign = from == contact ? -1 : 1, k = field_.k + sign * stop_.stiffness;
    const Field other{field_.h + sign * stop_.damping, k, field_.shake, 1, std::abs(1 - k) / 2};
    return from == contact ? other : in_its_norm(other);
  }
  [[nodiscard]] static Field in_its_norm(Field field) {
    if (field.k > 0) field.weight = std::sqrt(field.k), field.drift = 0;
    return field;
  }

  /// Whether all motions that have outrun the stop are still beyond its position when it pushes them again.
  [[nodiscard]] bool stays_beyond(const Passage& at, double wait, double s) const {
    const LocalBounds near = field_.near(at.speed, at.acceleration, wait);
    const double depth = stop_.into(last_.x - stop_.position), fastest = at.speed + near.acceleration * wait;
    return depth > bound_ / field_.weight + (fastest + near.growth * bound_) * s;
  }

  /// Maps the differences by the saltation matrix (eq. 53) and adds the bound of the second order (eq. 60); g changes
  /// by at most `most` in a unit of time, and s is the longest time between two crossings.
  [[nodiscard]] bool take_through(double jump, double most, double s) {
    const double k = std::abs(field_.k), share = k * s * s + 2 * field_.h * s;
    if (!(share <= 0.5)) return false;
    const Jacobian<double> saltation{1, 0, -jump, 1};
    first_order_ = first_order_.mapped(saltation), remainder_ = remainder_.mapped(saltation);
    const double force = (stop_.stiffness * s + jump) * most / (1 - share), square = s * s / 2;
    const double x = force * square, v = (stop_.stiffness * most + (2 * field_.h + k * s / 3) * force) * square;
    remainder_.add(Ellipse(2 * x * x, 0, 2 * v * v));
    return true;
  }

  /// The time after a separation for which its surface has to keep motions apart from contact: until all have passed
  /// the stop's position, unless they are so fast there that the stop can't push them.
  [[nodiscard]] double leaving_time(double speed) const {
    return 2 * stop_.stiffness * size() < stop_.damping * speed ? 0 : 5 * size() / speed;
  }
  /// Takes the motions out of the region beyond a soft stop's position, where nothing happens to them.
  template <class A>
  void leave(const A& arc) {
    const Motion<double> start = in_units(arc.start());
    field_ = Field::of(arc.constants(), rate_), leaving_ = true;
    holds_ = mode_ == outrun && approached_ == Side::none &&
             depart({std::abs(start.v), 0, std::abs(start.a), std::max(0.0, clear_from_ - now_)});
  }
  /// Whether none of the motions that have just left the stop is pushed by it: the damper would have to pull, or the
  /// time after the separation isn't over.
  [[nodiscard]] bool stays_left() const {
    return stop_.stiffness * reach_ < stop_.damping * departure_.speed ||
           2 * reach_ / departure_.speed <= departure_.waited;
  }

  /// The largest difference in the norm of an oscillator.
  [[nodiscard]] double size_in(const Field& field) const {
    const Jacobian<double> weigh{field.weight, 0, 0, 1};
    return first_order_.mapped(weigh).size() + remainder_.mapped(weigh).size() +
           rounding_ * std::max(1.0, field.weight);
  }
  /// The largest x + q v of a difference.
  [[nodiscard]] double change(double q) const {
    return first_order_.along(q) + remainder_.along(q) + rounding_ * (1 + q * std::max(1.0, field_.weight));
  }

  SoftStop<double> stop_{};  ///< the one that the mass is beyond, or was last
  Motion<double> last_{};    ///< the end of the last arc
  double bound_ = 0;         ///< of differences, in the norm of the present field
  double least_bound_ = 0;   ///< that of differences about an event, which is larger than before or after it
  Mode mode_ = unknown;
  bool leaving_ = false;  ///< the present flight began beyond a soft stop's position
};

}  // namespace clatter::motion
