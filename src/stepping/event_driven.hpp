#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "motion/chatter.hpp"
#include "stepping/loose_phases.hpp"

namespace clatter::stepping {

/// Event-driven integration: from contact to contact, chatter completed, rests released at their exact time.
template <class Method, class N, Effects E>
class EventDriven : public LoosePhases<Method, N, E> {
  using Base = LoosePhases<Method, N, E>;

 public:
  using Number = N;

  /// Looks for contacts with the stops in reach only.
  EventDriven(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits,
              const motion::ChatterRule<Number>& rule)
      : Base(scene, in_reach, limits),
        low_{low_beside(scene, Side::lower, rule), low_beside(scene, Side::upper, rule)},
        chatter_accuracy_(rule.accuracy) {}

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section (the stroboscopic section of
  /// `motion::State`), and reports every arc and event with its time since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                Observer& observer) {
    while (end - state.phase_turns > 2 * epsilon<Number>()) {
      this->report(state);
      const Outcome outcome = run_phase(state, end, origin, observer);
      if (outcome != Outcome::completed) return outcome;
      if constexpr (E.soft) this->keep_before_touch(state);
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
  /// | slips         | with the friction  | gap ahead, or force; velocity | the same; stick, rest, reversal       |
  /// | sticks        | held by friction   | its level, in closed form     | release                               |
  /// | in a housing  | free, and y''      | gaps to both walls            | impact of the loose mass, press       |
  /// | pressed       | both masses as one | force of the wall             | release                               |
  template <class Observer>
  [[nodiscard]] Outcome run_phase(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                  Observer& observer) {
    if constexpr (E.loose) {
      return this->run_loose(state, end, origin, observer);
    } else {
      if constexpr (E.friction)
        if (this->is_rough()) return run_rough_phase(state, end, origin, observer);
      if constexpr (E.soft) {
        if (this->has_soft_stops() && this->soft_stop_around(state) != Side::none)
          return state.pressed ? this->run_in_contact(state, end, origin, observer)
                               : this->run_beyond(state, end, origin, observer);
      }
      if (E.rest && state.chatters) return run_in_chatter(state, end, origin, observer);
      if (const auto stop = this->holding_stop(state)) return rest(state, *stop, end, origin, observer);
      return run_between(state, end, origin, observer);
    }
  }

  /// Flies, finds the contact, and rebounds.
  template <class Observer>
  [[nodiscard]] Outcome run_between(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                    Observer& observer) {
    const Number horizon = (end - state.phase_turns) * this->period();
    const auto [arc, contact] =
        this->method().fly(state, this->motion(this->constants(), state), this->anchor(state), horizon);
    if (!contact.resolved) return this->outcome_at(contact);
    const Side side = contact.side;
    if (side != Side::none && (this->is_hop(state, contact) || (contact.elapsed == 0 && state.v == 0))) {
      if (!E.soft || !is_soft(this->stops(), side) || !this->begin_pressed(state, contact))
        wait(state, side, end, origin, observer);
      return Outcome::completed;
    }
    observer.arc(arc, this->time(state, origin), static_cast<double>(contact.elapsed));
    this->pass(state, contact.elapsed);
    state.x = contact.motion.x, state.v = contact.motion.v, state.offset = contact.motion.offset,
    state.released = false;
    if (side == Side::none) {
      if (contact.elapsed == horizon) state.phase_turns = end;
      return Outcome::completed;
    }
    return meet(state, motion::stop_at<Number>(this->stops(), side), end, origin, observer);
  }

  /// An impact on a rigid stop, or the begin of a contact with a soft one.
  template <class Observer>
  [[nodiscard]] Outcome meet(motion::State<Number>& state, const motion::Stop<Number>& stop, const Number& end,
                             std::int64_t origin, Observer& observer) {
    if constexpr (E.soft)
      if (is_soft(this->stops(), stop.side)) return this->touch(state, stop.side, origin, observer);
    const bool touches = state.v == 0;  // no impact
    rebound(state, stop, end, origin, observer);
    return touches || this->count_impact() ? Outcome::completed : Outcome::event_budget;
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
  [[nodiscard]] static Number low_beside(const BasicScene<Number>& scene, Side side,
                                         const motion::ChatterRule<Number>& rule) {
    return E.rest ? Number(rule.low[index_of(side)] * motion::displacements_beside(scene, side)) : Number(0);
  }
  [[nodiscard]] std::optional<Number> chatter_time(const motion::State<Number>& state,
                                                   const motion::Stop<Number>& stop) const {
    const auto press = contact_force(this->constants(), stop, this->phase(state));
    const Number rebound = -stop.into(state.v), &low = low_[index_of(stop.side)];
    if constexpr (E.friction)
      if (this->is_rough())
        return rubbing_chatter_time(this->constants(), stop, press, this->slips().kinetic, this->slips().static_level,
                                    rebound, low, chatter_accuracy_);
    return motion::chatter_time(this->constants(), stop, press, rebound, low, chatter_accuracy_);
  }
  void complete(motion::State<Number>& state, const Number& left) const {
    this->pass(state, left);
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
      const motion::Crossing<Number> contact = next_in_chatter(state, horizon);
      if (!contact.resolved) return this->outcome_at(contact);
      this->pass(state, contact.elapsed);
      state.x = contact.motion.x, state.v = contact.motion.v, state.offset = contact.motion.offset;
      if (contact.side == Side::none && contact.elapsed == horizon) state.phase_turns = end;
      if (contact.side == Side::none) continue;
      state.x = stop.position, reverse(state, stop);  // under friction x was an ulp off
      if (state.v == 0) state.chatters = false;
    }
    this->show_chatter(begin, stop, Number(state.phase_turns - begin.phase_turns), state.v, origin, observer);
    return Outcome::completed;
  }

  /// The next contact of a flight of a chatter; under friction, which divides it, perhaps the peak before.
  [[nodiscard]] motion::Crossing<Number> next_in_chatter(motion::State<Number>& state, const Number& horizon) {
    if constexpr (E.friction)
      if (this->is_rough()) {
        const Side ahead = this->heading(state);
        auto crossing =
            this->method()
                .fly_within(this->slips().towards(ahead), state, this->motion(this->slips().towards(ahead), state),
                            this->anchor(state), this->slip_margins(state, ahead), horizon)
                .crossing;
        if (crossing.margin == 0) crossing.side = ahead;
        if (crossing.margin == 1) crossing.motion.v = 0;
        return crossing;
      }
    return this->method().fly(state, this->motion(this->constants(), state), this->anchor(state), horizon).crossing;
  }

  /// The phase at which a stop releases a mass, in turns since the section, 0 ... 1: the same number after every rest.
  [[nodiscard]] std::optional<Number> release_turns(const motion::Stop<Number>& stop) const {
    if constexpr (E.friction)
      if (this->is_rough()) {
        motion::State<Number> state;
        state.x = stop.position;
        return in_section(this->holding_at(state).release_phase(this->constants(), opposite(stop.side)));
      }
    return in_section(release_phase(this->constants(), stop));
  }
  /// A phase of the force counted from the section.
  [[nodiscard]] std::optional<Number> in_section(const std::optional<Number>& phase) const {
    if (!phase) return std::nullopt;
    return part_of_turn(Number(*phase - this->start_turns()));
  }
  /// A release at a phase if it is ahead and not beyond `end`. Just behind it is now, to rounding.
  [[nodiscard]] static std::optional<Number> upcoming(const std::optional<Number>& release, const Number& now,
                                                      const Number& end) {
    if (!release) return std::nullopt;
    const Number ahead = *release - now + (*release < now ? 1 : 0);
    const Number at = ahead > 1 - 16 * epsilon<Number>() ? now : *release;
    return at >= now && at <= end ? std::optional(at) : std::nullopt;
  }

  /// Holds the mass until its release or until `end`, whichever is first.
  template <class Observer>
  [[nodiscard]] Outcome rest(motion::State<Number>& state, const motion::Stop<Number>& stop, const Number& end,
                             std::int64_t origin, Observer& observer) {
    Number until = end;
    state.from_stop = stop.side, state.offset = 0;
    if (const auto release = upcoming(release_turns(stop), state.phase_turns, end))
      until = *release, state.released = true;
    this->show_rest(state, stop.side, Number(until - state.phase_turns), true, origin, observer);
    state.phase_turns = until;
    return Outcome::completed;
  }

  /// The phases of a mass under dry friction, which slips, or stands.
  template <class Observer>
  [[nodiscard]] Outcome run_rough_phase(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                        Observer& observer) {
    if (state.chatters) return run_in_chatter(state, end, origin, observer);
    this->end_creep(state);
    if (this->has_soft_stops() && this->soft_stop_around(state) != Side::none) {
      if (state.v == 0) state.pressed = true;  // the stop has come up to the mass
      if (!state.pressed) return this->run_beyond(state, end, origin, observer);
    }
    if (const auto holding = this->held(state)) return stand(state, *holding, end, origin, observer);
    return state.pressed ? slip_in_contact(state, end, origin, observer) : slip(state, end, origin, observer);
  }

  /// Holds a mass by friction, on a stop or anywhere, until its release or until `end`, whichever is first.
  template <class Observer>
  [[nodiscard]] Outcome stand(motion::State<Number>& state, const motion::Holding<Number>& holding, const Number& end,
                              std::int64_t origin, Observer& observer) {
    if (holding.stop != Side::none) state.from_stop = holding.stop, state.offset = 0;
    Number until = end;
    for (const Side side : {Side::lower, Side::upper})
      if (const auto release =
              upcoming(in_section(holding.release_phase(this->constants(), side)), state.phase_turns, until))
        until = *release, state.released = true;
    this->show_rest(state, holding.stop, Number(until - state.phase_turns), true, origin, observer);
    state.phase_turns = until;
    return Outcome::completed;
  }

  /// Slips until it meets the stop ahead, or its velocity falls to 0.
  template <class Observer>
  [[nodiscard]] Outcome slip(motion::State<Number>& state, const Number& end, std::int64_t origin, Observer& observer) {
    const Side ahead = this->heading(state);
    const auto stop = motion::stop_at<Number>(this->stops(), ahead);
    const bool begins = state.v == 0;
    const Number rounding = this->rounding_of_gap(state, stop);
    const auto margins = this->slip_margins(state, ahead);
    const auto crossing = this->cross(this->slips().towards(ahead), state, margins, end, origin, observer,
                                      this->slips().release_acceleration(ahead));
    if (!crossing.resolved) return this->outcome_at(crossing);
    if (begins && crossing.margin < 2 && crossing.elapsed == 0) return begin_anew(state, ahead, end, origin, observer);
    state.released = false;
    const bool still = this->is_still(crossing), touches = still && margins[0].of(crossing.motion) <= rounding;
    if (still && !touches) turn(state, ahead, origin, observer);
    if (crossing.margin != 0 && !touches) return Outcome::completed;
    state.x = stop.position;
    const Number brakes = -stop.into(crossing.motion.a), speed = stop.into(state.v);
    if (touches || speed < 0 || speed * speed <= 2 * brakes * rounding) state.v = 0;
    return meet(state, stop, end, origin, observer);
  }
  /// The same in contact with a soft stop, whose force may fall to 0.
  template <class Observer>
  [[nodiscard]] Outcome slip_in_contact(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                        Observer& observer) {
    const Side ahead = this->heading(state);
    const auto stop = motion::soft_stop_at<Number>(this->stops(), state.within);
    const std::array margins{motion::Margin<Number>{Number(0), stop.into(Number(1)), stop.into(stop.relaxation())},
                             motion::Margin<Number>{Number(0), Number(0), Number(sign_of(ahead))}};
    const bool begins = state.v == 0;
    const auto crossing = this->slips().in_contact(state.within, ahead, [&](const auto& constants) {
      return this->cross(constants, state, margins, end, origin, observer, this->slips().release_acceleration(ahead));
    });
    if (!crossing.resolved) return this->outcome_at(crossing);
    if (begins && crossing.margin < 2 && crossing.elapsed == 0) return begin_anew(state, ahead, end, origin, observer);
    state.released = false;
    if (crossing.margin == 0) this->separate(state, stop, origin, observer);
    if (this->is_still(crossing)) turn(state, ahead, origin, observer);
    return Outcome::completed;
  }
  /// Ends a slip towards a side: the mass sticks, as the next phase finds, or moves back at once.
  template <class Observer>
  void turn(motion::State<Number>& state, Side ahead, std::int64_t origin, Observer& observer) const {
    state.v = 0;
    if (this->held(state) || this->heading(state) == ahead) return;
    const Number push = this->push(state), rubs = sign_of(ahead) * this->slips().kinetic;
    this->show_reversal(state, Number(push - rubs), Number(push + rubs), origin, observer);
  }
  /// A mass without speed that would meet at once what is ahead: it enters the soft stop that it is on, else the force
  /// is within rounding of the level of friction, and it waits.
  template <class Observer>
  [[nodiscard]] Outcome begin_anew(motion::State<Number>& state, Side ahead, const Number& end, std::int64_t origin,
                                   Observer& observer) {
    const Number position = ahead == Side::upper ? Number(this->stops().upper) : Number(this->stops().lower);
    if (state.within == Side::none && is_soft(this->stops(), ahead) && state.x == position) {
      state.offset = 0, state.from_stop = state.within = ahead, state.pressed = true;
      return Outcome::completed;
    }
    wait(state, this->holding_at(state).stop, end, origin, observer);
    return Outcome::completed;
  }

  /// Moves a mass at rest past an instant at which the force that holds it is zero to rounding, so its sign decides
  /// nothing. After sqrt(epsilon) of a period it is clear of rounding; the mass moves by far less than an ulp.
  template <class Observer>
  void wait(motion::State<Number>& state, Side side, const Number& end, std::int64_t origin, Observer& observer) {
    using std::min, std::sqrt;
    const Number turns = min(Number(end - state.phase_turns), Number(sqrt(epsilon<Number>())));
    this->show_rest(state, side, turns, false, origin, observer);
    state.phase_turns += turns, state.released = false;
  }

  std::array<Number, 2> low_;  ///< [stop]: rebounds of chatter that is summed aren't higher
  Number chatter_accuracy_;    ///< of a sum
};

}  // namespace clatter::stepping
