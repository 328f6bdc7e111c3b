#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "motion/housed_arc.hpp"
#include "motion/relative_arc.hpp"
#include "motion/walls.hpp"
#include "stepping/soft_phases.hpp"

namespace clatter::stepping {

/// The phases of a main mass that carries a loose one, which flies between the walls of its housing, or is pressed onto
/// one of them.
template <class Method, class N, Effects E>
class LoosePhases : public SoftPhases<Method, N, E> {
  using Base = SoftPhases<Method, N, E>;

 public:
  using Number = N;

  LoosePhases(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits)
      : Base(scene, in_reach, limits), walls_(this->constants(), scene.loose) {}

 protected:
  /// Runs one phase up to its event, or to `end`.
  template <class Observer>
  [[nodiscard]] Outcome run_loose(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                  Observer& observer) {
    if (!state.loose.pressed && is_held(state)) press(state, state.loose.wall, Number(0), origin, observer);
    return state.loose.pressed ? run_pressed(state, end, origin, observer)
                               : run_in_housing(state, end, origin, observer);
  }

 private:
  using typename Base::Kind;

  /// The acceleration z'' with which a loose mass is driven into a wall that it is on.
  [[nodiscard]] Number into(Side side, const motion::State<Number>& state) const {
    return sign_of(side) * (walls_.load - this->motion(this->constants(), state, walls_.load).a);
  }
  /// Whether it lies on a wall that presses it.
  [[nodiscard]] bool is_held(const motion::State<Number>& state) const {
    const motion::LooseState<Number>& loose = state.loose;
    if (loose.wall == Side::none || loose.place != 0 || loose.speed != 0 || state.released) return false;
    return into(loose.wall, state) > 0;
  }
  /// The share of a motion below which a rebound is lost in its rounding. In 50 digits, the reference for double, it
  /// lies far below all that a double can tell, and above rounding, since each impact there takes up to a millisecond.
  [[nodiscard]] static Number faded() {
    if constexpr (std::numeric_limits<Number>::digits10 <= std::numeric_limits<double>::digits10)
      return epsilon<Number>();
    return Number(1e-30);
  }
  /// The speed of the main mass, or what its displacement stands for.
  [[nodiscard]] Number extent(const motion::State<Number>& state) const {
    using std::abs;
    const auto& c = this->constants();
    return abs(state.v) + c.natural * abs(state.x - c.equilibrium);
  }
  /// Whether nothing can tell the rest of a chatter: a rebound with the speed w changes no digit of the motion, or
  /// doesn't let time go on.
  [[nodiscard]] bool is_faded(const motion::State<Number>& state, const Number& w, const Number& pressing) const {
    if (!(pressing > 0)) return false;
    if (w == 0) return true;
    if (!(walls_.rule.law.R < 1)) return false;
    return w <= faded() * extent(state) || 2 * w <= pressing * epsilon<Number>() * this->period();
  }

  /// The main mass at an event, before which it had the velocity `before`.
  [[nodiscard]] static motion::Event::Main main_at(const motion::State<Number>& state, const Number& before) {
    return {static_cast<double>(state.x), static_cast<double>(before), static_cast<double>(state.v)};
  }
  template <class Observer>
  void press(motion::State<Number>& state, Side side, const Number& w, std::int64_t origin, Observer& observer) const {
    const Number before = state.v;
    state.v = walls_.rule.main_with(state.v, w);
    state.loose = {side, Number(0), Number(0), true}, state.released = false;
    observer.event({.kind = Kind::press,
                    .side = side,
                    .time = this->time(state, origin),
                    .before = static_cast<double>(w),
                    .place = static_cast<double>(walls_.place(side)),
                    .main = main_at(state, before)});
  }

  /// Moves on as one mass until the wall would have to pull.
  template <class Observer>
  [[nodiscard]] Outcome run_pressed(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                    Observer& observer) {
    const motion::Crossing<Number> crossing =
        move_as_one(state, state.loose.wall, horizon_of(state, end), end, origin, observer);
    if (!crossing.resolved) return this->outcome_at(crossing);
    if (crossing.margin == 0) state.loose.pressed = false, state.released = true;
    return Outcome::completed;
  }
  /// Whether a flight that begins with z' = w ends where nothing tells it from a press: at once, or on the wall that it
  /// begins on, from which it rises by less than rounding. The force of the wall touches zero there, and its sign is
  /// that of rounding.
  [[nodiscard]] bool is_lost(const motion::State<Number>& state, const motion::Crossing<Number>& contact,
                             const Number& w) const {
    using std::abs;
    if (contact.elapsed == 0 && w == 0) return true;
    const motion::LooseState<Number>& loose = state.loose;
    if (loose.wall != contact.side || loose.place != 0 || !(contact.elapsed <= this->shortest_hop())) return false;
    return abs(w) <= faded() * extent(state);
  }
  /// Holds the loose mass past an instant at which the force of its wall is zero to rounding, so its sign decides
  /// nothing. After sqrt(epsilon) of a period it is clear of rounding.
  template <class Observer>
  [[nodiscard]] Outcome wait(motion::State<Number>& state, const Number& w, const Number& end, std::int64_t origin,
                             Observer& observer) {
    using std::min, std::sqrt;
    const Number time = min(horizon_of(state, end), Number(sqrt(epsilon<Number>()) * this->period()));
    press(state, state.loose.wall, w, origin, observer);
    const motion::Crossing<Number> crossing = move_as_one(state, Side::none, time, end, origin, observer);
    state.loose.pressed = false;
    return this->outcome_at(crossing);
  }

  [[nodiscard]] Number horizon_of(const motion::State<Number>& state, const Number& end) const {
    return (end - state.phase_turns) * this->period();
  }
  /// Both masses as one, for a time or until a wall would have to pull.
  template <class Observer>
  motion::Crossing<Number> move_as_one(motion::State<Number>& state, Side pulled_by, const Number& horizon,
                                       const Number& end, std::int64_t origin, Observer& observer) {
    return walls_.carrying.with_constants([&](const auto& constants) {
      const auto flight = this->method().carry(constants, state, this->motion(constants, state), this->anchor(state),
                                               Pressing<Number>{pulled_by, walls_.load}, horizon);
      const motion::Crossing<Number>& crossing = flight.crossing;
      if (!crossing.resolved) return crossing;
      const double begin = this->time(state, origin), length = static_cast<double>(crossing.elapsed);
      const Side side = state.loose.wall;
      const double place = static_cast<double>(walls_.place(side));
      observer.arc(motion::HousedArc{flight.arc, motion::Pressed{side, place}}, begin, length);
      observer.event({Kind::hold, side, begin, 0.0, length, 0.0, place});
      go_on(state, crossing.elapsed, crossing.motion, end);
      return crossing;
    });
  }
  void go_on(motion::State<Number>& state, const Number& elapsed, const motion::Motion<Number>& there,
             const Number& end) const {
    const bool ends = elapsed == horizon_of(state, end);
    this->pass(state, elapsed);
    if (ends) state.phase_turns = end;
    state.x = there.x, state.v = there.v, state.released = false;
  }

  /// Flies between the walls to the next impact.
  template <class Observer>
  [[nodiscard]] Outcome run_in_housing(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                       Observer& observer) {
    const Number horizon = horizon_of(state, end);
    const auto flight = this->method().fly_in_housing(state, this->motion(this->constants(), state, walls_.load),
                                                      this->anchor(state), start_of(state), walls_, horizon);
    const auto& arc = flight.arc;
    const motion::Crossing<Number>& contact = flight.contact;
    if (!contact.resolved) return this->outcome_at(contact);
    if (const Number& w = arc.start().v; contact.side != Side::none && is_lost(state, contact, w)) {
      state.loose = {contact.side, Number(0), Number(0)};
      return wait(state, w, end, origin, observer);
    }
    const double begin = this->time(state, origin), length = static_cast<double>(contact.elapsed);
    observer.arc(motion::HousedArc{arc.main(), arc}, begin, length);
    move_loose(state.loose, contact);
    go_on(state, contact.elapsed, arc.main().at(contact.elapsed), end);
    if (contact.side == Side::none) return Outcome::completed;
    return strike(state, contact.side, contact.motion.v, origin, observer);
  }
  [[nodiscard]] motion::RelativeStart<Number> start_of(const motion::State<Number>& state) const {
    const motion::LooseState<Number>& loose = state.loose;
    if (loose.wall == Side::none) return {Number(0), loose.place - state.x, loose.speed - state.v, loose.speed};
    return {walls_.place(loose.wall), loose.place, loose.speed, loose.speed + state.v};
  }
  /// To the end of a flight.
  void move_loose(motion::LooseState<Number>& loose, const motion::Crossing<Number>& contact) const {
    if (contact.side != Side::none) {
      loose = {contact.side, Number(0), contact.motion.v};
    } else if (loose.wall != Side::none) {
      loose.place = contact.motion.offset, loose.speed = contact.motion.v;
    } else {
      loose.place += (loose.speed + walls_.load * contact.elapsed / 2) * contact.elapsed;
      loose.speed += walls_.load * contact.elapsed;
    }
  }

  /// An impact on a wall, after which that may press the loose mass.
  template <class Observer>
  [[nodiscard]] Outcome strike(motion::State<Number>& state, Side side, const Number& w, std::int64_t origin,
                               Observer& observer) {
    if (!(sign_of(side) * w > 0)) return Outcome::completed;  // it touches
    const Number before = state.v, after = walls_.rule.law.after(w);
    state.v = walls_.rule.main_after(state.v, w);
    state.loose = {side, Number(0), after};
    observer.event({.kind = Kind::strike,
                    .side = side,
                    .time = this->time(state, origin),
                    .before = static_cast<double>(w),
                    .after = static_cast<double>(after),
                    .place = static_cast<double>(walls_.place(side)),
                    .turns = static_cast<double>(state.phase_turns),
                    .main = main_at(state, before)});
    if (is_faded(state, -sign_of(side) * after, into(side, state))) press(state, side, after, origin, observer);
    return this->count_impact() ? Outcome::completed : Outcome::event_budget;
  }

  [[no_unique_address]] std::conditional_t<E.loose, motion::Walls<Number>, motion::NoWalls> walls_;
};

}  // namespace clatter::stepping
