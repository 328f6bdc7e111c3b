#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "motion/polynomial_arc.hpp"
#include "stepping/moreau_in_housing.hpp"
#include "stepping/theta_steps.hpp"

namespace clatter::stepping {

/// Moreau-Jean time stepping: the theta method with Newton's restitution at the level of velocities (Moreau 1988, Jean
/// 1999; Acary & Brogliato 2008, ch. 10). Events are not located: a step ends with the law of impact fulfilled if the
/// mass, moving on at its present velocity, would be beyond a stop after half of the step.
///
/// The position moves with the mean velocity, of weight theta at the end and 1 - theta at the beginning, so the impulse
/// acts 1 - theta of a step after its beginning, and the impact is reported there. Flights shorter than a step can't be
/// told from rest: a rebound that the force would end within the step is taken for rest.
///
/// A soft stop is a force, and acts in all of a step or in none: in those in the middle of which the mass, moving on at
/// its present velocity, would be pushed by it (eq. 50).
///
/// Dry friction is an impulse at the end of a step, of at most mu over it, that takes the velocity towards 0 and not
/// beyond: a mass sticks for whole steps. A step in which it stands, or turns back, ends without speed if the impulse
/// of all other forces is within the static level.
///
/// A loose mass has a specialization.
template <Effects E>
class Moreau : public ThetaSteps<E> {
  using Base = ThetaSteps<E>;

 public:
  static constexpr bool in_closed_form = false;

  explicit Moreau(const Scene& scene, const Integration& integration = {}, const Limits& limits = {})
      : Base(scene, integration, limits) {}

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section, and reports every step's arcs
  /// and events with their times since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(motion::State<double>& state, double end, std::int64_t origin, Observer& observer) {
    Stage<Moreau, Observer> stage(*this, state, end, origin, observer);
    sine_ = this->phase(state).sine;
    if constexpr (E.soft) begin_beyond(state);
    if (!bounce_off(stage)) return Outcome::event_budget;
    while (end - state.phase_turns > 2 * epsilon<double>()) {
      this->report(state);
      if (!step(stage, next_turns(state.phase_turns, end))) return Outcome::event_budget;
    }
    state.phase_turns = end;
    return this->outcome_of(state);
  }

 private:
  using Kind = motion::Event::Kind;

  /// Takes the impact of a mass that is on a stop and moves into it, as only a start can, before any time passes; false
  /// if it is one too many.
  template <class Stage>
  [[nodiscard]] bool bounce_off(Stage& stage) {
    motion::State<double>& state = stage.state;
    for (const Side side : {Side::lower, Side::upper}) {
      if (E.soft && is_soft(this->stops(), side)) continue;
      const auto stop = motion::stop_at<double>(this->stops(), side);
      if (state.x != stop.position || !(stop.into(state.v) > 0)) continue;
      const double before = std::exchange(state.v, stop.law.after(state.v));
      stage.show_impact(stop, before);
      return this->count_impact();
    }
    return true;
  }

  /// A step without regard to the stops.
  struct Free {
    double length, sine, v;  ///< in tau; sine of the forcing phase and velocity at its end
  };

  template <class Constants>
  [[nodiscard]] Free free_step(const Constants& constants, const motion::State<double>& state, double turns) {
    const auto end = this->step_end(constants, state, turns);
    return {end.length, end.sine, rubbed(end.momentum, state.v, end.length) / end.mass};
  }

  /// Of the momentum at the end of a step what friction leaves.
  [[nodiscard]] double rubbed(double momentum, double v, double length) const {
    if constexpr (E.friction) {
      if (!this->is_rough()) return momentum;
      const double most = this->slips().kinetic * length, hold = this->slips().static_level * length;
      const bool turns = momentum * v <= 0;  // or stands
      if (std::abs(momentum) <= most || (turns && std::abs(momentum - v) <= hold)) return 0.0;
      return momentum - std::copysign(most, momentum);
    }
    return momentum;
  }

  /// The rigid stop that the mass is beyond in the middle of the step, at its present velocity.
  [[nodiscard]] Side active(const motion::State<double>& state, double length) const {
    const double x = state.x + length / 2 * state.v;
    if (x <= this->stops().lower && !(E.soft && is_soft(this->stops(), Side::lower))) return Side::lower;
    return x >= this->stops().upper && !(E.soft && is_soft(this->stops(), Side::upper)) ? Side::upper : Side::none;
  }

  /// The soft stop beyond whose position the mass is, and whether it pushes, a time later at its present velocity.
  void look_beyond(motion::State<double>& state, double later) const {
    const auto around = motion::soft_stop_around(this->stops(), state.x + later * state.v, state.v);
    state.within = around.side, state.pressed = around.pressed;
  }
  /// A start beyond a soft stop's position is no touch.
  void begin_beyond(motion::State<double>& state) const {
    if (state.within == Side::none) look_beyond(state, 0.0);
  }

  /// Finds whether a soft stop acts in the next step, and reports a contact that begins or ends; false if it is one too
  /// many.
  template <class Stage>
  [[nodiscard]] bool meet(Stage& stage, double length) {
    motion::State<double>& state = stage.state;
    const Side was_within = state.within;
    const bool was_pressed = state.pressed;
    look_beyond(state, length / 2);
    const bool goes_on = was_pressed && state.pressed && was_within == state.within;
    if (was_pressed && !goes_on) stage.show_contact(Kind::separation, was_within);
    if (!state.pressed || goes_on) return true;
    stage.show_contact(was_within != state.within ? Kind::touch : Kind::renewal, state.within);
    return this->count_impact();
  }

  /// A step to the phase `turns`; false if it takes one impact too many.
  template <class Stage>
  [[nodiscard]] bool step(Stage& stage, double turns) {
    motion::State<double>& state = stage.state;
    if constexpr (E.soft) {
      if (!meet(stage, (turns - state.phase_turns) * this->period())) return false;
      if (state.pressed) {
        this->in_contact(state.within, [&](const auto& constants) {
          const Free pressed = free_step(constants, state, turns);
          if (!stand(stage, pressed, turns)) {
            turn(constants, stage, pressed);
            fly_in_contact(constants, stage, pressed);
          }
          sine_ = pressed.sine;
        });
        state.phase_turns = turns;
        return true;
      }
    }
    const Free free = free_step(this->constants(), state, turns);
    if (stand(stage, free, turns)) {
      state.phase_turns = turns, sine_ = free.sine;
      return true;
    }
    turn(this->constants(), stage, free);
    const Side side = active(state, free.length);
    const auto stop = motion::stop_at<double>(this->stops(), side);
    const bool impulse = side != Side::none && stop.into(free.v) > stop.into(stop.law.after(state.v));
    bool affordable = true;
    if (!impulse) {
      fly(slipping(state.v, free.v), 0.0, stage, free);
    } else if (state.v == 0) {
      rest(stage, stop, turns);
    } else {
      collide(stage, stop, free);
      affordable = this->count_impact();
    }
    state.phase_turns = turns, sine_ = free.sine;
    return affordable;
  }

  /// Whether friction holds the mass for a whole step, which is then reported: on a rigid stop as rest.
  template <class Stage>
  [[nodiscard]] bool stand(Stage& stage, const Free& free, double turns) {
    motion::State<double>& state = stage.state;
    if constexpr (E.friction) {
      if (!this->is_rough() || state.v != 0 || free.v != 0) return false;
      const Side side = active(state, free.length);
      if (side != Side::none) state.x = motion::stop_at<double>(this->stops(), side).position;
      stage.show_rest(side, turns - state.phase_turns, true);
      slid_ = 0.0;
      return true;
    }
    return false;
  }
  /// Reports that the mass has turned back since its last slip, in this step or at the end of the one before.
  template <class Constants, class Stage>
  void turn(const Constants& constants, Stage& stage, const Free& free) {
    motion::State<double>& state = stage.state;
    if constexpr (E.friction) {
      const double way = free.v != 0 ? free.v : state.v;
      if (!this->is_rough() || way == 0) return;
      const double push = force(constants, state.x, 0.0, sine_), rubs = std::copysign(this->slips().kinetic, way);
      const bool turns_back = std::exchange(slid_, way) * way < 0 && (push - rubs) * (push + rubs) > 0;
      if (turns_back && state.v * way <= 0) stage.show_reversal(push + rubs, push - rubs);
    }
  }
  /// The constants of a free mass in a step between two velocities.
  [[nodiscard]] const auto& slipping(double v, double v_end) const {
    if constexpr (E.friction)
      if (this->is_rough()) return this->slips().towards((v != 0 ? v : v_end) > 0 ? Side::upper : Side::lower);
    return this->constants();
  }
  template <class Constants, class Stage>
  void fly_in_contact(const Constants& constants, Stage& stage, const Free& pressed) const {
    motion::State<double>& state = stage.state;
    const double position = constants.stop.position;
    if constexpr (E.friction)
      if (this->is_rough()) {
        const Side ahead = (state.v != 0 ? state.v : pressed.v) > 0 ? Side::upper : Side::lower;
        return this->slips().in_contact(state.within, ahead,
                                        [&](const auto& slip) { fly(slip, position, stage, pressed); });
      }
    fly(constants, position, stage, pressed);
  }

  /// Moves on to the end of a step; arcs are given by distances from an anchor.
  template <Effects Of, class Stage>
  void fly(const motion::ArcConstants<double, Of>& constants, double anchor, Stage& stage, const Free& free) const {
    motion::State<double>& state = stage.state;
    const double x = state.x + free.length * (theta_ * free.v + (1 - theta_) * state.v);
    stage.show(arc(constants, anchor, state.phase_turns, free.length,
                   cubic(free.length, {state.x - anchor, state.v}, {x - anchor, free.v}),
                   cubic(free.length, {state.v, (free.v - state.v) / free.length},
                         {free.v, (free.v - state.v) / free.length})),
               free.length);
    state.x = x, state.v = free.v;
  }

  template <class Stage>
  void rest(Stage& stage, const motion::Stop<double>& stop, double turns) {
    motion::State<double>& state = stage.state;
    state.x = stop.position, slid_ = 0.0;
    stage.show_rest(stop.side, turns - state.phase_turns, true);
  }

  /// Moves with the velocity before the impulse until it acts, and with the one after it from there.
  template <class Stage>
  void collide(Stage& stage, const motion::Stop<double>& stop, const Free& free) {
    motion::State<double>& state = stage.state;
    const double before = stop.into(state.v) > 0 ? state.v : free.v;  // leaving too slowly: pushed back by the force
    const double pressed = stop.into(force(this->constants(), stop.position, 0.0, free.sine)),
                 rebound = -stop.into(stop.law.after(before));
    const double after = 2 * rebound > pressed * free.length && stop.into(state.v) > 0 ? stop.law.after(before) : 0;
    constexpr double least = 1e-6;  // of a step: the impact must not coincide with its beginning
    const double until = std::max(1 - theta_, least) * free.length;
    drift(stage, until);
    state.v = slid_ = after + 0.0;  // no negative zero
    stage.show_impact(stop, before);
    if (after == 0) {
      state.x = stop.position;
      stage.show_rest(stop.side, (free.length - until) / this->period(), true);
    } else {
      drift(stage, free.length - until);
    }
  }

  /// Moves on with the present velocity.
  template <class Stage>
  void drift(Stage& stage, double length) const {
    motion::State<double>& state = stage.state;
    const double x = state.x + length * state.v;
    stage.show(arc(slipping(state.v, state.v), 0.0, state.phase_turns, length,
                   cubic(length, {state.x, state.v}, {x, state.v}), cubic(length, {state.v, 0.0}, {state.v, 0.0})),
               length);
    state.x = x, state.phase_turns += length / this->period();
  }

  using Base::arc, Base::force, Base::next_turns, Base::sine_, Base::theta_;

  double slid_ = 0.0;  ///< velocity of the last slip; 0 if the mass has stood since
};

}  // namespace clatter::stepping
