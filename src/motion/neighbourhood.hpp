#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motion/contact.hpp"
#include "motion/contact_force.hpp"
#include "motion/ellipse.hpp"
#include "motion/event.hpp"
#include "motion/field.hpp"

namespace clatter::motion {

/// An observer of one motion that proves that all motions from an ellipse around its start meet the same stops in the
/// same order, and encloses their distance from it: one ellipse for the first order, by the derivative, a second for
/// the remainder.
///
/// Between impacts the difference of two motions is a free motion, whose energy norm d never grows (h >= 0, k = 1; for
/// other k it grows by eq. 48), so all keep clear of the stops if the observed one keeps clear of stops moved inwards
/// by d. Where the force is far faster than the spring, time is counted in its unit, so that a flight lasts about 1. At
/// an impact with speed u both are continued through the stop for a time |s| <= 2 d/u, and are transversal there if eq.
/// 29 holds. Then the difference after the impact is the saltation matrix (eq. 27) times the one before, and the
/// remainder is of second order, bounded by Taylor's theorem (`rebound`).
class Neighbourhood {
 public:
  /// All motions within `start`, a set of (x, v/`rate`); `rounding` bounds the error of these two. If the start is
  /// beside a stop and `have_met`, all of them are on the same side of their impact there as it is, or are continued to
  /// that.
  Neighbourhood(const Stops& stops, const Ellipse& start, double rounding, bool have_met = false, double rate = 1)
      : stops_(in_units(stops, rate)),
        first_order_(start),
        rounding_(rounding),
        reach_(start.size() + rounding),
        rate_(rate),
        have_met_(have_met) {}

  template <class A>
  void arc(const A& arc, double, double duration) {
    if (!holds_) return;
    const double length = rate_ * duration;
    field_ = Field::of(arc.constants(), rate_);
    note_jump(arc, duration);
    if (!std::exchange(begun_, true)) begin_beside_stop(in_units(arc.start()), field_.growth(length));
    const double begin = std::exchange(now_, now_ + length);
    grow(begin);
    const double from = std::max(0.0, clear_from_ - begin);
    if (approached_ == Side::none && from < length) clear(arc, begin, from, length);
    advance(arc.constants(), duration);
    force_ = acceleration(arc.constants().force(arc.phase_after(duration)));
    friction_ = acceleration(arc.constants().friction);
  }
  void event(const Event& event) {
    if (event.lasts()) holds_ = false;  // which impacts of a chatter are taken changes with the start
    if (event.kind == Event::Kind::impact && holds_)
      holds_ = approached_ == event.side && now_ >= clear_from_ &&
               rebound({event.side, event.before / rate_, event.after / rate_, event.place});
  }

  /// Whether the proof holds up to here; not while the mass is so near a stop that some of the motions may have met it.
  [[nodiscard]] bool holds() const { return holds_ && approached_ == Side::none; }
  /// Whether it holds up to here in a motion that meets `next` next: then some may have met that already.
  [[nodiscard]] bool holds_before(Side next) const {
    return holds_ && (approached_ == Side::none || approached_ == next);
  }
  /// The start, mapped by the derivative; of (x, v/`rate`), too.
  [[nodiscard]] const Ellipse& first_order() const { return first_order_; }
  /// To be added to `first_order`.
  [[nodiscard]] const Ellipse& remainder() const { return remainder_; }

 protected:
  /// A flight from a stop: the speed at its beginning, the acceleration away from the stop if all motions have had
  /// their impact there, else 0, and the bound of accelerations; those impacts are over within `waited`.
  struct Departure {
    double speed, pull, acceleration, waited;
  };
  /// An impact, with velocities in the unit of time.
  struct Rebound {
    Side side;
    double before, after, place;
  };
  /// Ends the proof if the force jumps at the beginning of an arc while some of the motions may not have had the last
  /// impact, and notes when it jumped, since later impacts must be clear of that, too.
  template <class A>
  void note_jump(const A& arc, double duration) {
    if (!arc.constants().is_in_pieces()) return;
    constexpr double least = 1e-6;  // jumps are by 1 or more
    const double sine = arc.start().sine;
    if (begun_ && std::abs(sine - last_sine_) > least) {
      holds_ = holds_ && now_ > departure_.waited && approached_ == Side::none;
      since_jump_ = 0;
    }
    since_jump_ += rate_ * duration, last_sine_ = arc.phase_after(duration).sine;
  }
  /// Begins to count time anew, at an event that all other instants lie before.
  void restart() { now_ = clear_from_ = 0; }
  /// How far the time since the last event, and between two instants since then, may be off.
  [[nodiscard]] double clock_rounding() const { return 4 * epsilon<double>() * now_; }
  /// Quantities in the unit of time.
  [[nodiscard]] double acceleration(double a) const { return a / (rate_ * rate_); }
  [[nodiscard]] Motion<double> in_units(Motion<double> m) const {
    m.v /= rate_, m.a = acceleration(m.a);
    return m;
  }
  [[nodiscard]] static Stops in_units(Stops stops, double rate) {
    stops.stiffness_lower /= rate * rate, stops.stiffness_upper /= rate * rate;
    stops.restitution_lower.scale_speeds(1 / rate), stops.restitution_upper.scale_speeds(1 / rate);
    return stops;
  }

  /// Maps both ellipses by the free motion of an arc that lasts so long in tau.
  template <class ArcConstants>
  void advance(const ArcConstants& constants, double duration) {
    const auto p = constants.propagator(duration);
    const Jacobian<double> free{p.a, rate_ * p.b, -constants.spring(p.b) / rate_, p.c};
    first_order_ = first_order_.mapped(free), remainder_ = remainder_.mapped(free);
  }

  /// Treats a motion that begins on or just beside a stop as one that leaves it, or that is about to meet it; beside it
  /// is as near as differences may be once they have grown.
  void begin_beside_stop(const Motion<double>& start, double growth) {
    for (const Side side : {Side::lower, Side::upper}) {
      const Stop<double> stop = stop_at<double>(stops_, side);
      if (!(std::abs(start.x - stop.position) <= growth * reach_)) continue;
      if (stop.into(start.v) < 0 || (have_met_ && start.v == 0)) {
        holds_ = depart({std::abs(start.v), have_met_ ? -stop.into(start.a) : 0.0, std::abs(start.a), 0});
        return;
      }
      if (have_met_) approached_ = side, approached_at_ = 0.0;
    }
  }

  /// Finds whether the flight, from the time `from` of this arc on, keeps clear of both stops or comes near one of
  /// them.
  template <class A>
  void clear(const A& arc, double begin, double from, double length) {
    const Stops inner{stops_.lower + reach_, stops_.upper - reach_, stops_.restitution_lower, stops_.restitution_upper};
    const auto start = from > 0 ? arc.at(from / rate_) : arc.start();
    holds_ = start.x > inner.lower && start.x < inner.upper;
    if (!holds_) return;
    const auto contact = next_contact(A(arc.constants(), start, arc.anchor()), inner, (length - from) / rate_);
    holds_ = contact.resolved;
    approached_ = contact.side, approached_at_ = begin + from + rate_ * contact.elapsed;
  }

  /// Takes the differences through an impact; false if they are not transversal there (eq. 29).
  [[nodiscard]] bool rebound(const Rebound& impact) {
    const Stop<double> stop = stop_at<double>(stops_, impact.side);
    const double u = std::abs(impact.before), R = stop.law.share(impact.before),
                 slope = -stop.law.derivative(impact.before), force = force_ - field_.k * impact.place;
    const double a_before = force - 2 * field_.h * impact.before,
                 a_after = force - 2 * friction_ - 2 * field_.h * impact.after;
    const double a = std::max(std::abs(a_before), std::abs(a_after)),
                 c = std::max(1.0, std::abs(field_.k)) + 2 * field_.h, wait = 2 * reach_ / u + clock_rounding();
    const LocalBounds near = field_.near(u, a, wait);
    if (since_jump_ <= wait) return false;
    if (!(near.acceleration * wait + near.growth * reach_ <= u / 2 && now_ - approached_at_ <= wait)) return false;

    const double x = first_order_.x() + remainder_.x() + rounding_, v = first_order_.v() + remainder_.v() + rounding_,
                 d = size();
    const double slowest = u - near.acceleration * (2 * d / u) - near.growth * d, s = x / slowest;  // |time between|
    const double missed = v * s + (near.acceleration + c * near.growth * d) * s * s / 2;            // of x + u s = 0
    const double turn = (slope * a_before + a_after) / impact.before;
    const double spread = v + near.acceleration * s + c * near.growth * d * s;  // of the speeds at the impact
    const auto bend = stop.law.bend(u - spread, u + spread);
    if (!bend) return false;
    const double rest_x =
        R * missed + near.acceleration * s * s / 2 + (std::abs(slope - R) + *bend * spread / 2) * spread * s;
    const double rest_v = std::abs(turn) * missed + (1 + slope) * near.jerk * s * s / 2 +
                          slope * c * near.growth * d * s + *bend * spread * spread / 2;
    const Jacobian<double> saltation{-R, 0, turn, -slope};
    first_order_ = first_order_.mapped(saltation), remainder_ = remainder_.mapped(saltation);
    const double rest = norm(rest_x, rest_v);
    remainder_.add(Ellipse::disc(rest + c * near.growth * s * (first_order_.size() + remainder_.size() + rest)));
    restart();
    return depart({R * u, -stop.into(a_after), a, wait});
  }

  /// Whether the mass leaves the stop, and does not meet the other one, before the flight is examined.
  [[nodiscard]] bool depart(const Departure& departure) {
    begin_flight(field_.near(departure.speed, departure.acceleration, departure.waited).growth * size());
    departure_ = departure;
    return leaves();
  }
  [[nodiscard]] bool leaves() {
    const auto& [speed, pull, acceleration, waited] = departure_;
    return leaves_after(std::max(waited, 2 * reach_ / speed), false) ||
           (pull > 0 && leaves_after(std::max(waited, 2 * std::sqrt(reach_ / pull)), true));
  }
  /// After this wait all motions are more than their differences away from the stop: either all keep half of their
  /// speed, or all are pulled away, with at least half of the acceleration.
  [[nodiscard]] bool leaves_after(double wait, bool by_pull) {
    const auto& [speed, pull, acceleration, waited] = departure_;
    const LocalBounds away = field_.near(speed, acceleration, wait);
    approached_ = Side::none, clear_from_ = flight_from_ + wait;
    const bool goes = by_pull ? away.jerk * wait + (std::abs(field_.k) + 2 * field_.h) * reach_ <= pull / 2
                              : away.acceleration * wait + reach_ <= speed / 2;
    return goes && (speed + away.acceleration * wait) * wait + reach_ < stops_.upper - stops_.lower;
  }
  /// The bound of differences in a flight, where it begins.
  void begin_flight(double reach) { flight_from_ = now_, reach_ = least_reach_ = reach; }
  /// Lets it grow to one that holds to the end of an arc (eq. 48); it has to hold from the departure on. An arc that a
  /// section cuts off just after that may be clear of the smaller one, and the next one not yet of this.
  void grow(double begin) {
    const double growth = field_.growth(now_ - flight_from_), was_clear_from = clear_from_;
    if (!(growth > 1)) return;
    reach_ = growth * least_reach_;
    if (approached_ != Side::none || departure_.speed + departure_.pull == 0) return;
    const bool all_leave = leaves();
    if (was_clear_from > begin)
      holds_ = holds_ && all_leave;
    else if (!all_leave)
      clear_from_ = was_clear_from;
  }

  [[nodiscard]] double size() const { return first_order_.size() + remainder_.size() + rounding_; }

  Stops stops_;
  Ellipse first_order_, remainder_{};
  double rounding_;
  double reach_;                  ///< bound of the energy norm of differences in the present flight
  double least_reach_ = reach_;   ///< the same at its beginning
  double now_ = 0.0;              ///< the time since the last event: that since the start has fewer digits
  double flight_from_ = 0.0;      ///< when it began, which is then; or since the last reversal under friction
  double rate_;                   ///< times, speeds and accelerations are those in units of 1/`rate_`
  Departure departure_{};         ///< the last one
  double clear_from_ = 0.0;       ///< until then a flight is near the stop that it began on
  Side approached_ = Side::none;  ///< the stop that some of the motions may have met already
  double approached_at_ = 0.0;    ///< the time from which they may have
  Field field_{};                 ///< of the last arc
  double force_ = 0;              ///< at its end,
  double friction_ = 0;           ///< of which so much is friction
  bool have_met_;                 ///< the stop that the start is on, if it is on one
  double since_jump_ = std::numeric_limits<double>::infinity();  ///< of the force, up to the end of the last arc
  double last_sine_ = 0;                                         ///< there
  bool begun_ = false;
  bool holds_ = true;
};

}  // namespace clatter::motion
