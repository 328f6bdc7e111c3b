#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "motion/contact.hpp"
#include "stepping/integrator.hpp"

namespace clatter::stepping {

/// An arc and its end: the first contact, else the horizon, or an earlier instant if the method divides the flight into
/// several arcs.
template <class A>
struct Flight {
  A arc;
  motion::Contact<typename A::Number> contact{};
};

/// Event-driven integration: from contact to contact, chatter completed, rests released at their exact time. The method
/// computes the flight and its contact: `fly(state, motion, anchor, horizon)`.
template <class Method, class N, Effects E>
class EventDriven : public IntegratorBase<N, E> {
  using Base = IntegratorBase<N, E>;

 public:
  using Number = N;
  using Base::Base;

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section (the stroboscopic section of
  /// `motion::State`), and reports every arc, rest and impact with its time since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                Observer& observer) {
    while (end - state.phase_turns > 2 * epsilon<Number>()) {  // fly, find the contact, rebound: the whole algorithm
      this->report(state);
      if (const auto stop = this->holding_stop(state)) {
        rest(state, *stop, end, origin, observer);
        continue;
      }
      const Number horizon = (end - state.phase_turns) * this->period();
      const auto [arc, contact] = static_cast<Method&>(*this).fly(state, motion(state), anchor(state), horizon);
      if (!contact.resolved) return this->finite(contact.motion.x) ? Outcome::unresolved : Outcome::not_finite;
      if (contact.side != Side::none && contact.elapsed == 0 && state.v == 0) {
        pass_zero_force(state, motion::stop_at<Number>(this->stops(), contact.side), end, origin, observer);
        continue;
      }
      observer.arc(arc, this->time(state, origin), static_cast<double>(contact.elapsed));
      pass(state, contact.elapsed);
      state.x = contact.motion.x, state.v = contact.motion.v, state.offset = contact.motion.offset,
      state.released = false;
      if (contact.side == Side::none && contact.elapsed == horizon) break;
      if (contact.side == Side::none) continue;
      const bool touches = state.v == 0;  // no impact
      rebound(state, motion::stop_at<Number>(this->stops(), contact.side), end, origin, observer);
      if (!touches && !this->count_impact()) return Outcome::event_budget;
    }
    state.phase_turns = end;
    return this->outcome_of(state);
  }

 private:
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
    state.from_stop = stop.side, state.offset = 0;
    if (stop.into(before) > 0) state.v = stop.law.after(before);
    if (state.v == 0) state.v = 0;  // no negative zero
    if (before != 0) this->show_impact(state, stop, before, origin, observer);
    if (!E.rest || state.v == 0) return;
    const auto left = chatter_time(this->constants(), stop, contact_force(this->constants(), stop, this->phase(state)),
                                   Number(-stop.into(state.v)));
    if (!left || state.phase_turns + *left / this->period() > end)
      return;  // a run that ends in a chatter ends in a flight
    this->show_rest(state, stop, Number(*left / this->period()), false, origin, observer);
    pass(state, *left);
    state.v = 0;
  }

  /// Holds the mass until its release or until `end`, whichever is first.
  template <class Observer>
  void rest(motion::State<Number>& state, const motion::Stop<Number>& stop, const Number& end, std::int64_t origin,
            Observer& observer) {
    using std::floor;
    Number until = end;
    state.from_stop = stop.side, state.offset = 0;
    if (const auto phase_of_release = release_phase(this->constants(), stop)) {
      Number release = *phase_of_release - this->start_turns();  // the same number after every rest
      release -= floor(release);
      if (release == 1) release = 0;  // rounded up
      const Number ahead = release - state.phase_turns + (release < state.phase_turns ? 1 : 0);
      if (ahead > 1 - 16 * epsilon<Number>())
        release = state.phase_turns;  // it is now, to rounding, not a whole turn ahead
      if (release >= state.phase_turns && release <= end) until = release, state.released = true;
    }
    this->show_rest(state, stop, Number(until - state.phase_turns), true, origin, observer);
    state.phase_turns = until;
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
};

}  // namespace clatter::stepping
