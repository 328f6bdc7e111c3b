#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "motion/event.hpp"
#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "observables/energy/energy.hpp"
#include "observables/energy/loose_energy.hpp"
#include "observables/energy/moving_stops_energy.hpp"
#include "observables/energy/quadrature.hpp"

namespace clatter::observables {

class Energy::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : oscillator_(span.scene.oscillator),
        stops_(span.scene.stops),
        friction_(span.scene.friction.kinetic),
        phase_(span.scene.start.phase) {
    if (move_by_themselves(stops_)) moving_.emplace(span);
    if (!has_loose_mass(span.scene.loose)) return;
    loose_load_ = span.scene.loose.load;
    settings.wall_energy ? void(share_.emplace(span.scene.loose)) : void(loose_.emplace(span));
  }

  template <class A>
  void arc(const A& arc, double begins, double length) {
    if (moving_) return moving_->arc(motion::main_of(arc), begins, length);
    if (loose_) return loose_->arc(arc, begins, length);
    if (share_) share_->arc(arc, length);
    if (!(length > 0)) return;
    const motion::Motion<double>& first = arc.start();
    see({first.x, arc.anchor(), first.offset}, first.v);
    integrate(arc, length);
  }
  void event(const motion::Event& event) {
    if (moving_) return moving_->event(event);
    if (loose_) return loose_->event(event);
    if (share_ && share_->event(event)) return;
    if (!event.lasts() && event.kind != motion::Event::Kind::impact) return;
    if (event.lasts() && event.length == 0 && event.before == 0) return;  // a loose mass strikes the held one at once
    see(Place(event.place), event.before);
    if (event.is_stick()) return press(event);
    const std::size_t stop = index_of(event.side);
    loss_impact_[stop] += (event.before - event.after) * (event.before + event.after) / 2;
    impulse_[stop] += !event.lasts()                          ? std::abs(event.after - event.before)
                      : event.before != 0 || event.after != 0 ? of_chatter(event)
                                                              : pressing(event);
  }

  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) {
    if (moving_) return moving_->finish(span, x, v);
    if (loose_) return with_loose_mass(span, x, v);
    const Place end = end_at(x);
    see(end, v);
    const double way = is_soft_ ? end.from(*begin_) : x - begin_->x;
    const double load_work = oscillator_.load * way;  // of a period only that of rounding
    Values values{.work_in = force_work_ + (span.periodic ? 0.0 : load_work),
                  .loss_damping = loss_damping_,
                  .loss_friction = loss_friction_};
    values.loss_impact = loss_impact_, values.impulse = impulse_;
    const double lost = loss_impact_[0] + loss_impact_[1], kinetic = (v - v_begin_) * (v + v_begin_);
    const double k = oscillator_.stiffness, spring = k * way * (x + begin_->x);
    values.energy_residual = force_work_ + load_work - loss_damping_ - loss_friction_ - lost - (kinetic + spring) / 2;
    if (is_soft_)
      values.energy_residual = force_work_ - loss_damping_ - loss_friction_ - lost - (kinetic / 2 + growth(end, way));
    values.impact_power = lost / span.total;
    if (share_) add_share(span, values);
    return values;
  }
  [[nodiscard]] double evaluations() const {  ///< of arcs
    return moving_ ? moving_->evaluations() : loose_ ? loose_->evaluations() : evaluations_;
  }

 private:
  [[nodiscard]] Values with_loose_mass(const ObservedSpan& span, double x, double v) {
    const LooseEnergy::Ledger ledger = loose_->finish(x, v);
    Values values{.work_in = ledger.work, .loss_damping = ledger.damped, .loss_friction = ledger.rubbed};
    values.loss_impact = ledger.lost, values.impulse = ledger.impulse;
    values.energy_residual = ledger.residual();
    values.impact_power = (ledger.lost[0] + ledger.lost[1]) / span.total;
    return values;
  }
  void add_share(const ObservedSpan& span, Values& values) const {
    values.wall_loss_impact = share_->lost(), values.wall_impulse = share_->impulse();
    const double lost = values.wall_loss_impact[0] + values.wall_loss_impact[1];
    if (!span.periodic) values.work_in += share_->work();
    values.loss_friction += share_->rubbed();
    values.energy_residual += share_->work() - lost - share_->rubbed() - share_->growth();
    values.impact_power += lost / span.total;
  }
  /// A displacement, and as an arc keeps it: its distance from an anchor has more digits beside a soft stop.
  struct Place {
    double x, anchor, offset = 0.0;

    explicit Place(double at) : x(at), anchor(at) {}
    Place(double at, double from, double distance) : x(at), anchor(from), offset(distance) {}
    [[nodiscard]] double from(const Place& other) const { return (anchor - other.anchor) + (offset - other.offset); }
    [[nodiscard]] double beyond(double position) const { return (anchor - position) + offset; }
  };
  /// A state of the motion; in the first that is seen the observed time begins.
  void see(const Place& place, double v) {
    if (!begin_) begin_ = place, v_begin_ = v;
    last_ = place;
  }
  /// The end of the observed time, at a displacement: where the last arc ends, unless a better state has replaced it.
  [[nodiscard]] Place end_at(double x) const {
    if (begin_ && x == begin_->x) return *begin_;
    const bool is_last = last_ && std::abs(last_->x - x) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(x);
    return is_soft_ && is_last ? *last_ : Place(x);
  }
  /// By how much the energy of the springs grows over that which the load gives, from the begin to a place: pressed
  /// onto a soft stop, all forces together, whose sum is small, times the way.
  [[nodiscard]] double growth(const Place& end, double way) const {
    double force = oscillator_.stiffness * (end.x + begin_->x) / 2 - oscillator_.load, stored = 0.0;
    for (const Side side : {Side::lower, Side::upper}) {
      const double from = depth_at(*begin_, side), to = depth_at(end, side), kappa = stiffness_of(side);
      if (from > 0 && to > 0)
        force += sign_of(side) * kappa * (from + to) / 2;
      else
        stored += kappa * (to - from) * (to + from) / 2;
    }
    return force * way + stored;
  }

  /// Over an arc, by panels in which neither v^2 nor v s(theta) turns by more than a few radians. The forces of both
  /// masses as one are shares of those on the main mass.
  template <class A>
  void integrate(const A& arc, double length) {
    const auto& constants = arc.constants();
    const double mass = 1 + constants.carried;
    if (stands_still(arc, length)) return press(arc, length);
    double work = 0, squares = 0, impulse = 0;
    const auto* stop = soft_stop_of(arc);
    evaluations_ += over_panels<20>(length, pace_of(constants), 2, [&](double s, double weight) {
      const motion::Motion<double> m = arc.at(s);
      work += weight * m.v * constants.drive(m).sine, squares += weight * m.v * m.v;
      if (stop != nullptr) impulse += weight * stop->force(stop->into(m.offset), stop->into(m.v));
    });
    force_work_ += mass * constants.f * work;
    if (is_soft_) {
      const motion::Motion<double> end = arc.at(length);
      last_ = Place(end.x, arc.anchor(), end.offset);
    }
    if (constants.friction != 0)
      loss_friction_ -= mass * constants.friction * (arc.at(length).offset - arc.start().offset);
    if (stop != nullptr) {
      loss_damping_ += 2 * oscillator_.damping * squares;
      loss_impact_[index_of(stop->side)] += mass * 2 * stop->damping * squares;
      impulse_[index_of(stop->side)] += mass * impulse;
    } else {
      loss_damping_ += mass * 2 * constants.h * squares;
      if (is_soft_) lose_stored({arc.start().x, arc.anchor(), arc.start().offset}, *last_);
    }
  }

  /// Whether a mass at its equilibrium stays there. An arc of it may last for a period of a very weak spring, of which
  /// that of the stop that it leans on is a tiny part.
  template <class A>
  [[nodiscard]] static bool stands_still(const A& arc, double length) {
    if (arc.constants().f != 0 || arc.start().v != 0) return false;
    const motion::Motion<double> middle = arc.at(length / 2), last = arc.at(length);
    return middle.v == 0 && last.v == 0 && middle.x == arc.start().x && last.x == arc.start().x;
  }
  template <class A>
  void press(const A& arc, double length) {
    const motion::Motion<double>& m = arc.start();
    if (const auto* const stop = soft_stop_of(arc); stop != nullptr)
      impulse_[index_of(stop->side)] += length * stop->force(stop->into(m.offset), stop->into(m.v));
  }
  /// The force of a soft stop, with which friction holds the mass.
  void press(const motion::Event& stick) {
    const Side side = soft_stop_beyond(stops_, stick.place);
    if (side == Side::none) return;
    const auto stop = motion::soft_stop_at<double>(stops_, side);
    impulse_[index_of(side)] += stick.length * stop.force(stop.into(stick.place - stop.position), 0.0);
  }
  /// The soft stop that an arc is in contact with, or nullptr.
  template <class A>
  [[nodiscard]] static const motion::SoftStop<double>* soft_stop_of(const A& arc) {
    if constexpr (A::effects.stiffness)
      if (arc.constants().stop.side != Side::none) return &arc.constants().stop;
    return nullptr;
  }
  /// How far beyond the position of a soft stop a place is; 0: not beyond, or the stop is rigid.
  [[nodiscard]] double depth_at(const Place& place, Side side) const {
    if (!is_soft(stops_, side)) return 0.0;
    return std::max(0.0, sign_of(side) * place.beyond(side == Side::upper ? stops_.upper : stops_.lower));
  }
  [[nodiscard]] double stiffness_of(Side side) const {
    if (!is_soft(stops_, side)) return 0.0;
    return side == Side::upper ? stops_.stiffness_upper : stops_.stiffness_lower;
  }
  /// A stop that the mass outruns loses the energy of its spring as it relaxes.
  void lose_stored(const Place& from, const Place& to) {
    for (const Side side : {Side::lower, Side::upper}) {
      const double before = depth_at(from, side), after = depth_at(to, side);
      loss_impact_[index_of(side)] += stiffness_of(side) * (before - after) * (before + after) / 2;
    }
  }

  /// Integral of the force that presses the mass into a stop, eq. 22, over a rest. A pull away from the stop is none of
  /// its own: friction holds the mass against that.
  [[nodiscard]] double pressing(const motion::Event& rest) const {
    if (friction_ == 0) return pressing(rest, rest.time, rest.length);
    const double constant = sign_of(rest.side) * constant_force_at(rest), force = std::abs(oscillator_.forcing);
    if (constant >= force) return pressing(rest, rest.time, rest.length);
    if (constant <= -force) return 0.0;
    if (oscillator_.shape.has_orders()) return pressing_by_orders(rest, constant);
    if (!oscillator_.shape.is_sine()) return pressing_in_piece(rest, constant);
    // the force is a sine of a phase that begins with it, and presses between two of its zeros
    const double begin = phase_ + oscillator_.frequency * rest.time +
                         (sign_of(rest.side) * oscillator_.forcing < 0 ? pi<double>() : 0.0),
                 end = begin + oscillator_.frequency * rest.length, rises = std::asin(-constant / force),
                 turn = 2 * pi<double>();
    double sum = 0.0;
    for (double turns = std::floor((begin - rises) / turn) * turn; turns + rises < end; turns += turn) {
      const double from = std::max(begin, turns + rises), to = std::min(end, turns + pi<double>() - rises);
      if (from < to)
        sum += pressing(rest, rest.time + (from - begin) / oscillator_.frequency, (to - from) / oscillator_.frequency);
    }
    return sum;
  }
  /// The same of a force in pieces, of which a rest has one: between the instants at which the force changes sign.
  [[nodiscard]] double pressing_in_piece(const motion::Event& rest, double constant) const {
    const double period = period_of(oscillator_), begin = turns_at(rest.time), end = begin + rest.length / period;
    std::array<double, 4> ends{begin, end, end, end};
    std::size_t count = 1;
    for (const bool rises : {false, true})
      if (const auto zero = phase_of_shape(oscillator_.shape, sign_of(rest.side) * oscillator_.forcing, -constant,
                                           rises, begin + rest.length / period / 2)) {
        const double at = *zero + std::ceil(begin - *zero);
        if (at < end) ends[count++] = at;
      }
    ends[count] = end;
    if (count == 3 && ends[2] < ends[1]) std::swap(ends[1], ends[2]);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      sum += std::max(0.0, pressing(rest, rest.time + (ends[i] - begin) * period, (ends[i + 1] - ends[i]) * period));
    return sum;
  }
  /// The same of a sum of sines.
  [[nodiscard]] double pressing_by_orders(const motion::Event& rest, double constant) const {
    const double period = period_of(oscillator_), begin = turns_at(rest.time), end = begin + rest.length / period;
    double sum = 0.0;
    for (double here = begin; here < end;) {
      double next = end;
      for (const bool rises : {false, true})
        if (const auto zero = phase_of_orders(oscillator_.shape.orders, sign_of(rest.side) * oscillator_.forcing,
                                              -constant, rises, here))
          if (const double ahead = part_of_turn(*zero - here); ahead > 1e-12) next = std::min(next, here + ahead);
      sum += std::max(0.0, pressing(rest, rest.time + (here - begin) * period, (next - here) * period));
      here = next;
    }
    return sum;
  }
  /// The phase of the force, in turns.
  [[nodiscard]] double turns_at(double time) const {
    return phase_ / (2 * pi<double>()) + time / period_of(oscillator_);
  }
  /// With the load of a loose mass that the one at rest carries, or with its friction.
  [[nodiscard]] double constant_force_at(const motion::Event& rest) const {
    return constant_force(oscillator_, rest.place) + rest.carried * loose_load_ + rest.rubbing;
  }
  [[nodiscard]] double pressing(const motion::Event& rest, double time, double length) const {
    const Oscillator& o = oscillator_;
    double sum = constant_force_at(rest) * length;
    if (o.forcing != 0 && o.shape.has_orders()) {
      o.shape.orders.each(sine_cosine_of_turns(turns_at(time + length / 2)), [&](int j, double value, double) {
        const double half = j * o.frequency * length / 2;
        sum += o.forcing * value * length * (half == 0 ? 1.0 : std::sin(half) / half);
      });
    } else if (o.forcing != 0 && !o.shape.is_sine()) {
      const double swing = swing_of(o.shape) * o.frequency * length / 2,
                   s = shape_at(o.shape, turns_at(time + length / 2)).sine;
      sum += o.forcing * s * length * (swing == 0 ? 1.0 : std::sin(swing) / swing);
    } else if (o.forcing != 0) {
      const double half = o.frequency * length / 2;
      sum += 2 * o.forcing / o.frequency * std::sin(phase_ + o.frequency * time + half) * std::sin(half);
    }
    return sign_of(rest.side) * sum;
  }
  /// The impulse of a chatter that is summed: the mass has its momentum back in the end, and friction, which presses it
  /// on while it rises, has held it off for longer while it fell.
  [[nodiscard]] double of_chatter(const motion::Event& rest) const {
    const double sum = pressing(rest, rest.time, rest.length);
    const double given_back = sum - sign_of(rest.side) * (rest.after - rest.before);
    if (friction_ == 0 || !(rest.length > 0)) return given_back;
    // falls and rises take times as (a + mu)^(1/2) to (a - mu)^(1/2)
    const double a = sum / rest.length;
    if (!(a > friction_)) return given_back;
    const double both = a + std::sqrt((a - friction_) * (a + friction_));
    return given_back - friction_ * friction_ / both * rest.length;
  }

  Oscillator oscillator_;
  Stops stops_;
  bool is_soft_ = has_soft_stop(stops_);
  double friction_;  ///< kinetic level
  double phase_;     ///< of the force at the beginning, a section
  std::optional<Place> begin_{}, last_{};
  double v_begin_ = 0;
  double force_work_ = 0, loss_damping_ = 0, loss_friction_ = 0;
  std::array<double, 2> loss_impact_{}, impulse_{};  ///< [stop]
  double evaluations_ = 0;
  std::optional<MovingStopsEnergy> moving_{};  ///< beside stops that move by themselves, in place of all others
  std::optional<LooseEnergy> loose_{};  ///< with a loose mass on a main one without events, in place of all others
  std::optional<LooseShare> share_{};   ///< with another loose mass, beside all others
  double loose_load_ = 0.0;
};

}  // namespace clatter::observables
