#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "motion/housed_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "stepping/any_observer.hpp"
#include "stepping/carrying.hpp"
#include "stepping/laws.hpp"
#include "stepping/step_velocities.hpp"

namespace clatter::stepping {

/// Moreau-Jean time stepping: the theta method with Newton's restitution at the level of velocities (Moreau 1988, Jean
/// 1999; Acary & Brogliato 2008, ch. 10). Events are not located. A step ends with the law of impact fulfilled if the
/// mass, moving on at its present velocity, would be beyond a stop, or a loose one beyond a wall, after half of the
/// step.
///
/// Positions move with the mean velocity, of weight theta at the end and 1 - theta at the beginning, so the impulse
/// acts 1 - theta of a step after its beginning, and the impact is reported there. Flights shorter than a step can't be
/// told from rest: a rebound that the force would end within the step is taken for rest. If both masses have an impact
/// in one step, the loose one has its own in the next.
///
/// A soft stop is a force, and acts in all of a step or in none: in those in the middle of which the mass, moving on at
/// its present velocity, would be pushed by it (eq. 50).
///
/// Dry friction is an impulse at the end of a step, of at most its level over it, that takes the velocity towards 0 and
/// not beyond: a mass sticks for whole steps. A step in which it stands, or turns back, ends without speed if the
/// impulse of all other forces is within the static level.
///
/// A loose mass flies, or slides beside a main mass that friction draws along, or moves with that as one for whole
/// steps: in those in which the wall has to push, and friction to hold no more than it can.
template <Effects E>
class Moreau : public StepVelocities<E> {
  using Base = StepVelocities<E>;
  using typename Base::Kind, typename Base::State, typename Base::Step;

 public:
  static constexpr bool in_closed_form = false;
  using Any = ObserverOf<DenseArcs, E>;

  explicit Moreau(const Scene& scene, const Integration& integration = {}, const Limits& limits = {})
      : Base(scene, integration, limits), housing_(*this, with_numbers<double>(scene)) {}

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section, and reports every step's arcs
  /// and events with their times since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(State& state, double end, std::int64_t origin, Observer& observer) {
    Any any(observer);
    return advance_long(state, end, origin, any);
  }
  /// The same, compiled once for all observers.
  [[nodiscard]] Outcome advance_long(State& state, double end, std::int64_t origin, Any& observer);

  [[nodiscard]] const motion::Walls<double>& walls() const requires(E.loose) { return housing_.walls; }

 private:
  /// The loose mass in a part of a step: z' at its end and y'', or moving with the main mass.
  struct Beside {
    double w = 0.0, load = 0.0;
    bool as_one = false;
  };

  /// Takes the impacts of masses that are on a stop, or a wall, and move into it, as only a start can, before any time
  /// passes; false if it is one too many.
  template <class Stage>
  [[nodiscard]] bool bounce_off(Stage& stage) {
    State& state = stage.state;
    for (const Side side : {Side::lower, Side::upper}) {
      if (E.soft && is_soft(this->stops(), side)) continue;
      const auto stop = motion::stop_at<double>(this->stops(), side);
      if (state.x != stop.position || !(stop.into(state.v) > 0)) continue;
      const double before = std::exchange(state.v, stop.law.after(state.v));
      laws::keep_on(state, before);
      stage.show_impact(stop, before);
      if (!this->count_impact()) return false;
    }
    if constexpr (E.loose) {
      const motion::LooseState<double> loose = state.loose;
      const auto& rule = walls().rule;
      if (walls().lies_on_wall(loose) && sign_of(loose.wall) * loose.speed > 0)
        return strike(stage, loose.wall, loose.speed, rule.law(loose.wall).after(loose.speed),
                      rule.main_after(state.v, loose.speed));
    }
    return true;
  }

  /// A step to the phase `turns`; false if it takes one impact too many.
  template <class Stage>
  [[nodiscard]] bool step(Stage& stage, double turns) {
    State& state = stage.state;
    const double length = (turns - state.phase_turns) * this->period();
    if constexpr (E.soft)
      if (!this->meet(stage, length)) return false;
    bool affordable = true;
    if constexpr (E.loose)
      affordable = step_in_housing(stage, turns);
    else
      affordable = perform(*this, stage, this->step_of(*this, state, turns), {});
    state.phase_turns = turns;
    return affordable;
  }

  /// Carries out a step of the main mass; false if it takes one impact too many.
  template <class Mass, class Stage>
  [[nodiscard]] bool perform(const Mass& mass, Stage& stage, const Step& step, const Beside& beside) {
    State& state = stage.state;
    bool affordable = true;
    if (step.holds(state.v)) {
      hold(mass, stage, step, step.length, beside);
    } else {
      this->turn(mass, stage, step);
      if (step.hits(state.v))
        affordable = collide(mass, stage, step, beside);
      else
        move(mass, stage, step.length, step.v, beside);
    }
    this->drive_ = step.drive;
    return affordable;
  }

  /// Moves with the velocities before the impulse of a stop until it acts, and with those after it from there.
  template <class Mass, class Stage>
  [[nodiscard]] bool collide(const Mass& mass, Stage& stage, const Step& step, const Beside& beside) {
    State& state = stage.state;
    const auto stop = motion::stop_at<double>(this->stops(), step.stop);
    const double before = this->arriving(stop, state.v, step), until = this->until_impulse(step);
    drift(mass, stage, until, beside);
    state.v = this->slid_ = step.v;
    if constexpr (E.loose) {
      motion::LooseState<double>& loose = state.loose;  // y' has no impulse
      loose.speed = loose.wall != Side::none ? beside.w : loose.speed + beside.load * step.length;
    }
    stage.show_impact(stop, before);
    if (step.v == 0)
      hold(mass, stage, step, step.length - until, beside);
    else
      drift(mass, stage, step.length - until, beside);
    return this->count_impact();
  }

  /// Moves on to a velocity, which changes evenly.
  template <class Mass, class Stage>
  void move(const Mass& mass, Stage& stage, double length, double v_end, const Beside& beside) {
    const State& state = stage.state;
    const double x = state.x + this->way(length, state.v, v_end);
    const auto go = [&](const auto& constants, double anchor) {
      const auto main = this->arc(constants, anchor, state.phase_turns, length,
                                  cubic(length, {state.x - anchor, state.v}, {x - anchor, v_end}),
                                  this->ramp(length, state.v, v_end));
      pass(stage, main, length, x, v_end, beside);
    };
    const Side ahead = (state.v != 0 ? state.v : v_end) > 0 ? Side::upper : Side::lower;
    const bool is_within = E.soft && state.pressed;
    const double anchor = is_within ? motion::stop_at<double>(mass.stops(), state.within).position : 0.0;
    const auto anchored = [&](const auto& constants) { go(constants, anchor); };
    if constexpr (E.friction)
      if (mass.is_rough())
        return is_within ? mass.slips().in_contact(state.within, ahead, anchored)
                         : anchored(mass.slips().towards(ahead));
    this->with_oscillator(mass, state, anchored);
  }
  /// Moves on with the present velocities.
  template <class Mass, class Stage>
  void drift(const Mass& mass, Stage& stage, double length, Beside beside) {
    if constexpr (E.loose) beside.w = modes::loose_start_of(*this, stage.state).w;
    move(mass, stage, length, stage.state.v, beside);
  }
  /// A stop, or friction, holds the main mass: on a rigid stop that is rest.
  template <class Mass, class Stage>
  void hold(const Mass& mass, Stage& stage, const Step& step, double length, const Beside& beside) {
    State& state = stage.state;
    const Side side = step.stands ? this->active(state, step.length) : step.stop;
    if (side != Side::none) state.x = motion::stop_at<double>(this->stops(), side).position;
    state.v = this->slid_ = 0.0;
    const auto& constants = mass.constants();
    stage.show_rest(side, length / this->period(), true, beside.as_one ? constants.carried : 0.0,
                    beside.as_one ? 0.0 : constants.rubbing);
    if constexpr (E.loose) {
      const auto none = this->ramp(length, 0.0, 0.0);
      pass(stage, this->arc(housing_.held(beside.as_one), state.x, state.phase_turns, length, none, none), length,
           state.x, 0.0, beside);
    }
  }

  /// Shows a part of a step in which the main mass moves to x with the velocity v there, and goes on to its end.
  template <class Stage, class A>
  void pass(Stage& stage, const A& main, double length, double x, double v, const Beside& beside) {
    State& state = stage.state;
    if constexpr (!E.loose) {
      stage.show(main, length);
      state.x = x, state.v = v;
    } else if (beside.as_one) {
      modes::show_as_one(*this, stage, main, length);
      state.x = x, state.v = v;
    } else {
      const motion::RelativeStart<double> from = modes::loose_start_of(*this, state);
      const double offset = from.offset + this->way(length, from.w, beside.w);
      const motion::PolynomialInHousing in_housing(main, from.origin, beside.load,
                                                   cubic(length, {from.offset, from.w}, {offset, beside.w}),
                                                   this->ramp(length, from.w, beside.w));
      if (state.loose.pushed)
        Base::show_at_wall(*this, stage, in_housing, length);
      else
        stage.show(motion::HousedArc{main, in_housing}, length);
      state.x = x, state.v = v;
      if (state.loose.wall != Side::none || beside.load != 0 || state.loose.speed != 0)
        Base::move_loose(state, offset, beside.w);
    }
    stage.pass(length);
  }

  /// A step with a loose mass; false if it takes one impact too many.
  template <class Stage>
  [[nodiscard]] bool step_in_housing(Stage& stage, double turns) {
    State& state = stage.state;
    motion::LooseState<double>& loose = state.loose;
    const motion::RelativeStart<double> from = modes::loose_start_of(*this, state);
    if (!loose.pressed && !this->meet_soft_wall(*this, stage, from, (turns - state.phase_turns) * this->period()))
      return false;
    return housing_.carrying.with_mass([&](const auto& both) {
      Side towards = from.w < 0 ? Side::lower : Side::upper;
      if (loose.pressed || (walls().is_rough() && from.w == 0)) {
        const Step step = this->step_of(both, state, turns);
        const auto hold = Base::hold_in(walls(), state, step, 0.0, walls().hold);
        loose.pressed = hold.holds && !step.hits(state.v);  // it goes on with its velocity where the main mass bounces
        if (loose.pressed) return perform(both, stage, step, {.as_one = true});
        towards = hold.leaves_to();
      }
      return beside(towards,
                    [&](const auto& mass, double load) { return fly(both, mass, stage, turns, from, towards, load); });
    });
  }
  /// Calls `function(mass, load)` with the main mass, and y'', while the loose one flies, or slides to a side.
  template <class Function>
  decltype(auto) beside(Side towards, Function&& function) const {
    if (!walls().is_rough()) return function(static_cast<const MainMass<double, E>&>(*this), walls().load);
    return function(housing_.slide(towards).mass, housing_.slide(towards).walls.load);
  }

  /// A step in which the loose mass moves in its housing, meets a wall, or comes to a stop.
  template <class Both, class Mass, class Stage>
  [[nodiscard]] bool fly(const Both& both, const Mass& mass, Stage& stage, double turns,
                         const motion::RelativeStart<double>& from, Side towards, double load) {
    State& state = stage.state;
    const auto pushed = [&](bool is_held) { return this->impulse_of_wall(mass, state, turns, walls(), load, is_held); };
    double push = pushed(false);
    Step step = this->step_of(mass, state, turns, push);
    if (push != 0 && step.holds(state.v)) push = pushed(true), step = this->step_of(mass, state, turns, push);
    const double w = from.w + (load * step.length - push / walls().rule.ratio - (step.v - state.v));
    const Side wall = step.hits(state.v) ? Side::none : Base::active_wall(walls(), from, step.length);
    if (wall != Side::none && sign_of(wall) * w > sign_of(wall) * walls().rule.law(wall).after(from.w)) {
      if (from.w != 0) return meet_wall(both, mass, stage, turns, step, {wall, from.w, w, load});
      press(stage, wall);
      return perform(both, stage, this->step_of(both, state, turns), {.as_one = true});
    }
    const bool turns_back = walls().is_rough() && from.w != 0 && !(sign_of(towards) * w > 0) && !step.hits(state.v);
    if (turns_back) return stop_sliding(both, mass, stage, turns, from.w, towards);
    return perform(mass, stage, step, {w, load});
  }
  /// Ends a slide, or turns it back.
  template <class Both, class Mass, class Stage>
  [[nodiscard]] bool stop_sliding(const Both& both, const Mass& mass, Stage& stage, double turns, double w,
                                  Side towards) {
    State& state = stage.state;
    const double load = housing_.slide(towards).walls.load, kinetic = std::abs(load - walls().load);
    const Step step = this->step_of(both, state, turns, walls().rule.share() * w);
    const auto stops = Base::hold_in(walls(), state, step, w, kinetic);
    const double others = stops.needed + w / (1 + walls().rule.ratio);  // than what z' takes itself
    if (stops.holds || std::abs(others) <= walls().hold * step.length) {
      const bool affordable = perform(mass, stage, step, {0.0, load});
      state.loose.speed = 0, state.loose.pressed = true;
      return affordable;
    }
    return beside(opposite(towards), [&](const auto& turned, double driven) {
      const double push = this->impulse_of_wall(turned, state, turns, walls(), driven, false);
      const Step back = this->step_of(turned, state, turns, push);
      const double drawn = driven * back.length - push / walls().rule.ratio;
      return perform(turned, stage, back, {w + (drawn - (back.v - state.v)), driven});
    });
  }

  /// A loose mass that meets a wall within a step: z' at its beginning, and at its end without the wall; y''.
  struct Meeting {
    Side wall;
    double w, w_free, load;
  };
  /// Moves with the velocities before the impulse of a wall until it acts, and with those after it from there. `alone`:
  /// the step of the main mass without that impulse.
  template <class Both, class Mass, class Stage>
  [[nodiscard]] bool meet_wall(const Both& both, const Mass& mass, Stage& stage, double turns, const Step& alone,
                               const Meeting& meeting) {
    State& state = stage.state;
    const Side wall = meeting.wall;
    const double w = meeting.w, load = meeting.load;
    const int sign = sign_of(wall);
    const double before = sign * w > 0 ? w : meeting.w_free;  // leaving too slowly: pushed back by the forces
    const double rebound = walls().rule.law(wall).after(before), until = this->until_impulse(alone);
    const double a = alone.holds(state.v) ? 0.0 : this->force(mass.constants(), state.x, state.v, alone.drive);
    const bool flies = -2 * sign * rebound > sign * (load - a) * alone.length && sign * w > 0;
    const double after = flies ? rebound + 0.0 : 0.0;
    const Step struck = this->step_of(both, state, turns, walls().rule.share() * (w - after));
    alone.holds(state.v) ? hold(mass, stage, alone, until, {w, load}) : drift(mass, stage, until, {w, load});
    const auto there = modes::loose_start_of(*this, state);
    const bool affordable = strike(stage, wall, before, after, struck.free);
    if (flies)
      state.loose.place = there.origin + there.offset - walls().place(wall);
    else
      press(stage, wall);
    const auto go_on = [&](const auto& of) {
      const Beside then{after, load, !flies};
      const double left = alone.length - until;
      struck.stands ? hold(of, stage, struck, left, then) : drift(of, stage, left, then);
    };
    flies ? go_on(mass) : go_on(both);
    this->drive_ = alone.drive;
    return affordable;
  }

  /// Changes the velocities by an impact, and reports it; false if it is one too many.
  template <class Stage>
  [[nodiscard]] bool strike(Stage& stage, Side side, double before, double after, double v_after) {
    State& state = stage.state;
    const double v_before = std::exchange(state.v, v_after);
    state.loose = {side, 0.0, after + 0.0};  // no negative zero
    laws::tell(*this, stage, Kind::strike, side, before, state.loose.speed, v_before);
    return this->count_impact();
  }
  template <class Stage>
  void press(Stage& stage, Side side) const {
    State& state = stage.state;
    state.loose = {side, 0.0, 0.0, true};
    laws::tell(*this, stage, Kind::press, side, 0.0, 0.0, state.v);
  }

  [[no_unique_address]] std::conditional_t<E.loose, Housing<double, E>, NoHousing> housing_;
};

}  // namespace clatter::stepping
