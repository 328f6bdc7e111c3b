#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "motion/chatter.hpp"
#include "motion/contact.hpp"
#include "stepping/integrator.hpp"

namespace clatter::stepping {

/// An arc and its end: the first of its margins that falls to 0, else the horizon, or an earlier instant if the method
/// divides the flight into several arcs.
template <class A>
struct ArcToEvent {
  A arc;
  motion::Crossing<typename A::Number> crossing{};
};

/// Event-driven integration: from contact to contact, chatter completed, rests released at their exact time. The method
/// computes the flight and its contact: `fly(state, motion, anchor, horizon)`; beyond the position of a soft stop
/// `fly_within(constants, state, motion, anchor, margins, horizon)`.
template <class Method, class N, Effects E>
class EventDriven : public IntegratorBase<N, E> {
  using Base = IntegratorBase<N, E>;

 public:
  using Number = N;

  /// Looks for contacts with the stops in reach only.
  EventDriven(const Scene& scene, const Stops& in_reach, const Limits& limits, const motion::ChatterRule<Number>& rule)
      : Base(scene, in_reach, limits),
        low_{rule.low[0] * motion::displacements_beside(scene, Side::lower),
             rule.low[1] * motion::displacements_beside(scene, Side::upper)},
        chatter_accuracy_(rule.accuracy),
        soft_stops_(has_soft_stop(scene.stops)) {}

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section (the stroboscopic section of
  /// `motion::State`), and reports every arc, rest and impact with its time since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                Observer& observer) {
    while (end - state.phase_turns > 2 * epsilon<Number>()) {
      this->report(state);
      const Outcome outcome = run_phase(state, end, origin, observer);
      if (outcome != Outcome::completed) return outcome;
    }
    state.phase_turns = end;
    return this->outcome_of(state);
  }

  /// The state in which a stop releases a mass from rest, in the first forcing period; nothing if it never does.
  [[nodiscard]] std::optional<motion::State<Number>> released_from(Side side) const {
    const auto stop = motion::stop_at<Number>(this->stops(), side);
    const auto turns = release_turns(stop);
    if (!turns) return std::nullopt;
    motion::State<Number> state;
    state.x = stop.position, state.from_stop = side, state.released = true, state.phase_turns = *turns;
    return state;
  }

 private:
  /// Runs one phase up to its event, or to `end`: the whole algorithm.
  ///
  /// | phase         | oscillator         | margins                       | events                                |
  /// |---------------|--------------------|-------------------------------|---------------------------------------|
  /// | between stops | free               | gaps to both stops            | impact, rest; touch of a soft stop    |
  /// | in chatter    | free               | the same                      | its end, in rest                      |
  /// | at rest       | held by a stop     | its force, in closed form     | release                               |
  /// | in contact    | with the soft stop | its force                     | separation                            |
  /// | beyond a stop | free               | depth; pull of the soft stop  | back between the stops; renewal       |
  template <class Observer>
  [[nodiscard]] Outcome run_phase(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                  Observer& observer) {
    if constexpr (E.soft) {
      if (soft_stops_ && soft_stop_around(state) != Side::none)
        return state.pressed ? run_in_contact(state, end, origin, observer) : run_beyond(state, end, origin, observer);
    }
    if (E.rest && state.chatters) return run_in_chatter(state, end, origin, observer);
    if (const auto stop = this->holding_stop(state)) return rest(state, *stop, end, origin, observer);
    return run_between(state, end, origin, observer);
  }

  /// Flies, finds the contact, and rebounds.
  template <class Observer>
  [[nodiscard]] Outcome run_between(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                    Observer& observer) {
    const Number horizon = (end - state.phase_turns) * this->period();
    const auto [arc, contact] = static_cast<Method&>(*this).fly(state, motion(state), anchor(state), horizon);
    if (!contact.resolved) return outcome_at(contact);
    const Side side = contact.side;
    if (side != Side::none && contact.elapsed == 0 && state.v == 0) {
      if (!E.soft || !is_soft(this->stops(), side) || !begin_pressed(state, contact))
        pass_zero_force(state, motion::stop_at<Number>(this->stops(), side), end, origin, observer);
      return Outcome::completed;
    }
    observer.arc(arc, this->time(state, origin), static_cast<double>(contact.elapsed));
    pass(state, contact.elapsed);
    state.x = contact.motion.x, state.v = contact.motion.v, state.offset = contact.motion.offset,
    state.released = false;
    if (side == Side::none) {
      if (contact.elapsed == horizon) state.phase_turns = end;
      return Outcome::completed;
    }
    if constexpr (E.soft)
      if (is_soft(this->stops(), side)) return touch(state, side, origin, observer);
    const bool touches = state.v == 0;  // no impact
    rebound(state, motion::stop_at<Number>(this->stops(), side), end, origin, observer);
    return touches || this->count_impact() ? Outcome::completed : Outcome::event_budget;
  }

  [[nodiscard]] motion::Motion<Number> motion(const motion::State<Number>& state) const {
    const auto [sine, cosine] = this->phase(state);
    const Number offset = state.from_stop == Side::none ? Number(0) : state.offset;
    const Number displacement = this->constants().from_equilibrium(state.x, anchor(state), offset);
    const Number a = state.released ? Number(0) : this->constants().acceleration(displacement, state.v, sine);
    return {offset, state.x, state.v, a, sine, cosine};
  }
  /// The position that the offset of the present flight counts from.
  [[nodiscard]] Number anchor(const motion::State<Number>& state) const {
    return state.from_stop == Side::none ? state.x : motion::stop_at<Number>(this->stops(), state.from_stop).position;
  }
  void pass(motion::State<Number>& state, const Number& elapsed) const {
    state.phase_turns += elapsed / this->period();
  }

  /// Reverses the velocity (eq. 4) and completes the chatter that may follow.
  template <class Observer>
  void rebound(motion::State<Number>& state, const motion::Stop<Number>& stop, const Number& end, std::int64_t origin,
               Observer& observer) {
    const Number before = state.v;
    reverse(state, stop);
    if (before != 0) this->show_impact(state, stop, before, origin, observer);
    if (!E.rest || state.v == 0) return;
    const auto left = chatter_time(state, stop);
    if (!left) return;
    state.chatters = true;
    if (state.phase_turns + *left / this->period() > end) return;  // it flies on, or its state at the end isn't known
    this->show_chatter(state, stop, Number(*left / this->period()), Number(0), origin, observer);
    complete(state, *left);
  }
  void reverse(motion::State<Number>& state, const motion::Stop<Number>& stop) const {
    state.from_stop = stop.side, state.offset = 0;
    if (stop.into(state.v) > 0) state.v = stop.law.after(state.v);
    if (state.v == 0) state.v = 0;  // no negative zero
  }
  [[nodiscard]] std::optional<Number> chatter_time(const motion::State<Number>& state,
                                                   const motion::Stop<Number>& stop) const {
    return motion::chatter_time(this->constants(), stop, contact_force(this->constants(), stop, this->phase(state)),
                                Number(-stop.into(state.v)), low_[index_of(stop.side)], chatter_accuracy_);
  }
  void complete(motion::State<Number>& state, const Number& left) const {
    pass(state, left);
    state.v = 0, state.chatters = false;
  }

  /// Flies through a chatter that is summed but goes on beyond `end`, until it is complete or up to `end`: a section
  /// neither begins a sum nor shows impacts of it.
  template <class Observer>
  [[nodiscard]] Outcome run_in_chatter(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                       Observer& observer) {
    const auto stop = motion::stop_at<Number>(this->stops(), state.from_stop);
    const motion::State<Number> begin = state;
    while (state.chatters && end - state.phase_turns > 2 * epsilon<Number>()) {
      if (state.offset == 0) {
        const auto left = chatter_time(state, stop);
        if (left && state.phase_turns + *left / this->period() <= end) {
          complete(state, *left);
          break;
        }
      }
      const Number horizon = (end - state.phase_turns) * this->period();
      const motion::Crossing<Number> contact =
          static_cast<Method&>(*this).fly(state, motion(state), anchor(state), horizon).crossing;
      if (!contact.resolved) return outcome_at(contact);
      pass(state, contact.elapsed);
      state.x = contact.motion.x, state.v = contact.motion.v, state.offset = contact.motion.offset;
      if (contact.side == Side::none && contact.elapsed == horizon) state.phase_turns = end;
      if (contact.side != Side::none) reverse(state, stop);
      if (state.v == 0) state.chatters = false;
    }
    this->show_chatter(begin, stop, Number(state.phase_turns - begin.phase_turns), state.v, origin, observer);
    return Outcome::completed;
  }

  /// The phase at which a stop releases a mass, in turns since the section, 0 ... 1: the same number after every rest.
  [[nodiscard]] std::optional<Number> release_turns(const motion::Stop<Number>& stop) const {
    const auto phase_of_release = release_phase(this->constants(), stop);
    if (!phase_of_release) return std::nullopt;
    return part_of_turn(Number(*phase_of_release - this->start_turns()));
  }

  /// Holds the mass until its release or until `end`, whichever is first.
  template <class Observer>
  [[nodiscard]] Outcome rest(motion::State<Number>& state, const motion::Stop<Number>& stop, const Number& end,
                             std::int64_t origin, Observer& observer) {
    Number until = end;
    state.from_stop = stop.side, state.offset = 0;
    if (auto release = release_turns(stop)) {
      const Number ahead = *release - state.phase_turns + (*release < state.phase_turns ? 1 : 0);
      if (ahead > 1 - 16 * epsilon<Number>())
        release = state.phase_turns;  // it is now, to rounding, not a whole turn ahead
      if (*release >= state.phase_turns && *release <= end) until = *release, state.released = true;
    }
    this->show_rest(state, stop, Number(until - state.phase_turns), true, origin, observer);
    state.phase_turns = until;
    return Outcome::completed;
  }

  /// The soft stop beyond whose position the mass is.
  [[nodiscard]] Side soft_stop_around(motion::State<Number>& state) const {
    if (state.within != Side::none) return state.within;
    const auto [side, offset, pressed] = motion::soft_stop_around(this->stops(), state.x, state.v);
    if (side != Side::none) state.within = state.from_stop = side, state.offset = offset, state.pressed = pressed;
    return side;
  }

  /// Begins a contact with a soft stop at its position. A mass that only touches, without speed, flies on.
  template <class Observer>
  [[nodiscard]] Outcome touch(motion::State<Number>& state, Side side, std::int64_t origin, Observer& observer) {
    state.from_stop = side, state.offset = 0;
    if (state.v == 0) return Outcome::completed;
    state.within = side, state.pressed = true;
    this->show_touch(state, true, origin, observer);
    return this->count_impact() ? Outcome::completed : Outcome::event_budget;
  }
  /// Presses a mass without speed into the soft stop that it is on, if the force does so.
  [[nodiscard]] bool begin_pressed(motion::State<Number>& state, const motion::Crossing<Number>& contact) const {
    const auto stop = motion::soft_stop_at<Number>(this->stops(), contact.side);
    if (!(stop.into(contact.motion.a) > 0)) return false;
    state.x = stop.position, state.offset = 0, state.from_stop = state.within = contact.side, state.pressed = true;
    return true;
  }

  /// In contact with a soft stop until its force falls to 0 (eqs. 50 and 51).
  template <class Observer>
  [[nodiscard]] Outcome run_in_contact(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                       Observer& observer) {
    const auto stop = motion::soft_stop_at<Number>(this->stops(), state.within);
    const motion::Margin<Number> force{Number(0), stop.into(Number(1)), stop.into(stop.relaxation())};
    return this->in_contact(state.within, [&](const auto& constants) {
      const Number offset = state.offset, v = state.v;
      const auto crossing = cross(constants, state, std::array{force}, end, origin, observer);
      if (crossing.resolved && crossing.margin == 0) {
        if (constants.h == 0 && constants.f == 0) state.v = stop.into(-constants.speed_at_stop(offset, v));
        separate(state, stop, origin, observer);
      }
      return outcome_at(crossing);
    });
  }
  /// Free beyond a soft stop's position until the mass comes back to that, or the stop, which relaxes at once, pushes
  /// again.
  template <class Observer>
  [[nodiscard]] Outcome run_beyond(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                   Observer& observer) {
    const auto stop = motion::soft_stop_at<Number>(this->stops(), state.within);
    const Number one = stop.into(Number(1));
    const motion::Margin<Number> depth{Number(0), one, Number(0)}, pull{Number(0), -one, -stop.into(stop.relaxation())};
    const auto crossing = cross(this->constants(), state, std::array{depth, pull}, end, origin, observer);
    if (crossing.resolved && crossing.margin == 0) leave(state, stop);
    if (crossing.resolved && crossing.margin == 1) {
      state.pressed = true;
      this->show_touch(state, false, origin, observer);
      if (!this->count_impact()) return Outcome::event_budget;
    }
    return outcome_at(crossing);
  }
  [[nodiscard]] static Outcome outcome_at(const motion::Crossing<Number>& crossing) {
    if (crossing.resolved) return Outcome::completed;
    return Base::finite(crossing.motion.x) ? Outcome::unresolved : Outcome::not_finite;
  }

  /// One arc with these constants, up to the first margin that falls to 0.
  template <class Constants, std::size_t count, class Observer>
  motion::Crossing<Number> cross(const Constants& constants, motion::State<Number>& state,
                                 const std::array<motion::Margin<Number>, count>& margins, const Number& end,
                                 std::int64_t origin, Observer& observer) {
    const auto [sine, cosine] = this->phase(state);
    const Number from = anchor(state), displacement = constants.from_equilibrium(state.x, from, state.offset);
    const motion::Motion<Number> start{
        state.offset, state.x, state.v, constants.acceleration(displacement, state.v, sine), sine, cosine};
    const Number horizon = (end - state.phase_turns) * this->period();
    const auto [arc, crossing] =
        static_cast<Method&>(*this).fly_within(constants, state, start, from, margins, horizon);
    if (!crossing.resolved) return crossing;
    observer.arc(arc, this->time(state, origin), static_cast<double>(crossing.elapsed));
    pass(state, crossing.elapsed);
    state.x = crossing.motion.x, state.v = crossing.motion.v, state.offset = crossing.motion.offset;
    return crossing;
  }

  /// Ends a contact. Without a damper the stop's force falls to 0 at its position.
  template <class Observer>
  void separate(motion::State<Number>& state, const motion::SoftStop<Number>& stop, std::int64_t origin,
                Observer& observer) const {
    state.pressed = false;
    this->show_separation(state, stop.side, origin, observer);
    if (stop.damping == 0 || !(stop.into(state.offset) > 0)) leave(state, stop);
  }
  /// Leaves the region beyond a soft stop's position.
  static void leave(motion::State<Number>& state, const motion::SoftStop<Number>& stop) {
    state.x = stop.position, state.offset = 0, state.within = Side::none, state.pressed = false;
  }

  /// Moves a mass at rest past an instant at which the contact force is zero to rounding, so its sign decides nothing.
  /// After sqrt(epsilon) of a period the force is clear of rounding; the mass moves by far less than an ulp.
  template <class Observer>
  void pass_zero_force(motion::State<Number>& state, const motion::Stop<Number>& stop, const Number& end,
                       std::int64_t origin, Observer& observer) {
    using std::min, std::sqrt;
    const Number turns = min(Number(end - state.phase_turns), Number(sqrt(epsilon<Number>())));
    this->show_rest(state, stop, turns, false, origin, observer);
    state.phase_turns += turns, state.released = false;
  }

  std::array<Number, 2> low_;  ///< [stop]: rebounds of chatter that is summed aren't higher
  Number chatter_accuracy_;    ///< of a sum
  bool soft_stops_;            ///< asked at each arc: general methods have one set of effects for soft and rigid stops
};

}  // namespace clatter::stepping
