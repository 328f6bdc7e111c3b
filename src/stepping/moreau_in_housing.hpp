#pragma once

#include <algorithm>
#include <cstdint>

#include "motion/housed_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "motion/walls.hpp"
#include "stepping/theta_steps.hpp"

namespace clatter::stepping {

template <Effects E>
class Moreau;

/// Moreau-Jean time stepping of a main mass that carries a loose one. A step ends with Newton's law fulfilled by z' if
/// the loose mass, moving on at its present z', would be beyond a wall after half of the step; the impulse acts on both
/// momenta, 1 - theta of a step after its beginning. A rebound that the forces would end within the step is taken for
/// rest: the wall presses the loose mass, in whole steps of both masses as one, until a step in which it would have to
/// pull.
template <Effects E>
requires(E.loose) class Moreau<E> : public ThetaSteps<E> {
  using Base = ThetaSteps<E>;

 public:
  static constexpr bool in_closed_form = false;

  explicit Moreau(const Scene& scene, const Integration& integration = {}, const Limits& limits = {})
      : Base(scene, integration, limits), walls_(scene.loose), carrying_(this->constants(), scene.loose) {}

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section, and reports every step's arcs
  /// and events with their times since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(motion::State<double>& state, double end, std::int64_t origin, Observer& observer) {
    Stage<Moreau, Observer> stage(*this, state, end, origin, observer);
    this->sine_ = this->phase(state).sine;
    if (!bounce_off(stage)) return Outcome::event_budget;
    while (end - state.phase_turns > 2 * epsilon<double>()) {
      this->report(state);
      if (!step(stage, this->next_turns(state.phase_turns, end))) return Outcome::event_budget;
    }
    state.phase_turns = end;
    return this->outcome_of(state);
  }

 private:
  using StepEnd = typename Base::StepEnd;
  using Kind = motion::Event::Kind;

  /// A loose mass: z = origin + offset, and z'.
  struct Loose {
    double origin, offset, w;
  };
  [[nodiscard]] Loose loose_of(const motion::State<double>& state) const {
    const motion::LooseState<double>& loose = state.loose;
    if (loose.wall == Side::none) return {0.0, loose.place - state.x, loose.speed - state.v};
    return {walls_.place(loose.wall), loose.place, loose.speed};
  }

  /// Takes the impact of a loose mass that is on a wall and moves into it, as only a start can, before any time passes;
  /// false if it is one too many.
  template <class Stage>
  [[nodiscard]] bool bounce_off(Stage& stage) {
    motion::State<double>& state = stage.state;
    const motion::LooseState<double> loose = state.loose;
    if (loose.wall == Side::none || loose.place != 0 || !(sign_of(loose.wall) * loose.speed > 0)) return true;
    const double v_after = walls_.rule.main_after(state.v, loose.speed);
    return strike(stage, loose.wall, loose.speed, walls_.rule.law(loose.wall).after(loose.speed), v_after);
  }

  /// The wall that the loose mass is beyond in the middle of a step, at its present z'.
  [[nodiscard]] Side active(const Loose& loose, double length) const {
    const double z = loose.origin + (loose.offset + length / 2 * loose.w);
    return z <= walls_.places.lower ? Side::lower : z >= walls_.places.upper ? Side::upper : Side::none;
  }

  /// A step to the phase `turns`; false if it takes one impact too many.
  template <class Stage>
  [[nodiscard]] bool step(Stage& stage, double turns) {
    motion::State<double>& state = stage.state;
    const StepEnd free = this->step_end(this->constants(), state, turns);
    const Loose loose = loose_of(state);
    const double v_free = free.momentum / free.mass,
                 w_free = loose.w + (walls_.load * free.length - (v_free - state.v));
    const Side side = state.loose.pressed ? state.loose.wall : active(loose, free.length);
    const int sign = sign_of(side);
    bool affordable = true;
    if (side == Side::none || !(sign * w_free > sign * walls_.rule.law(side).after(loose.w))) {
      state.loose.pressed = false;
      fly(stage, loose, free.length, v_free, w_free);
    } else if (state.loose.pressed || loose.w == 0) {
      if (!state.loose.pressed) press(stage, side);
      carry(stage, turns);
    } else {
      affordable = collide(stage, loose, side, free, w_free, turns);
    }
    state.phase_turns = turns, this->sine_ = free.sine;
    return affordable;
  }

  /// Both masses without an impact to the end of a step.
  template <class Stage>
  void fly(Stage& stage, const Loose& loose, double length, double v_end, double w_end) const {
    motion::State<double>& state = stage.state;
    const double way = this->way(length, state.v, v_end), offset = loose.offset + this->way(length, loose.w, w_end);
    const auto main = this->arc(this->constants(), state.x, state.phase_turns, length,
                                cubic(length, {0.0, state.v}, {way, v_end}), this->ramp(length, state.v, v_end));
    const motion::PolynomialInHousing in_housing(main, loose.origin, walls_.load,
                                                 cubic(length, {loose.offset, loose.w}, {offset, w_end}),
                                                 this->ramp(length, loose.w, w_end));
    stage.show(motion::HousedArc{main, in_housing}, length);
    state.x += way, state.v = v_end;
    move_loose(state, offset, w_end);
  }
  /// A loose mass that has met no wall counts by y, so that one which stands stays exactly there.
  void move_loose(motion::State<double>& state, double offset, double w) const {
    motion::LooseState<double>& loose = state.loose;
    if (loose.wall != Side::none)
      loose.place = offset, loose.speed = w;
    else if (walls_.load != 0 || loose.speed != 0)
      loose.place = state.x + offset, loose.speed = state.v + w;
  }

  /// Both as one while a wall presses, to the phase `turns`, at the end of which the velocity is that of the step.
  template <class Stage>
  void carry(Stage& stage, double turns) {
    motion::State<double>& state = stage.state;
    carrying_.with_constants([&](const auto& constants) {
      const StepEnd both = this->step_end(constants, state, turns);
      hold(constants, stage, both.length, both.momentum / both.mass);
    });
  }
  template <class Constants, class Stage>
  void hold(const Constants& constants, Stage& stage, double length, double v_end) const {
    motion::State<double>& state = stage.state;
    const double way = this->way(length, state.v, v_end), begin = stage.time();
    const Side side = state.loose.wall;
    const auto arc = this->arc(constants, state.x, state.phase_turns, length,
                               cubic(length, {0.0, state.v}, {way, v_end}), this->ramp(length, state.v, v_end));
    stage.show(motion::HousedArc{arc, motion::Pressed{side, walls_.place(side)}}, length);
    stage.show({.kind = Kind::hold,
                .side = side,
                .time = begin,
                .length = length,
                .place = walls_.place(side),
                .has_arc = true});
    state.x += way, state.v = v_end;
  }

  /// Moves with the velocities before the impulse until it acts, and with those after it from there.
  template <class Stage>
  [[nodiscard]] bool collide(Stage& stage, const Loose& loose, Side side, const StepEnd& free, double w_free,
                             double turns) {
    motion::State<double>& state = stage.state;
    const int sign = sign_of(side);
    const double before = sign * loose.w > 0 ? loose.w : w_free;  // leaving too slowly: pushed back by the forces
    const double rebound = walls_.rule.law(side).after(before);
    const double pressing = sign * (walls_.load - this->force(this->constants(), state.x, state.v, free.sine));
    const bool flies = -2 * sign * rebound > pressing * free.length && sign * loose.w > 0;
    const double after = flies ? rebound : 0.0, share = walls_.rule.ratio / (walls_.rule.ratio + free.mass);
    const double v_after = free.momentum / free.mass - share * (after - w_free);
    constexpr double least = 1e-6;  // of a step: the impact must not coincide with its beginning
    const double until = std::max(1 - this->theta_, least) * free.length;
    fly(stage, loose, until, state.v, loose.w);
    state.phase_turns += until / this->period();
    const double offset = loose.origin + (loose.offset + until * loose.w) - walls_.place(side);
    const bool affordable = strike(stage, side, before, after, v_after);
    if (flies) {
      state.loose.place = offset;
      fly(stage, loose_of(state), free.length - until, state.v, after);
    } else {
      press(stage, side);
      carrying_.with_constants([&](const auto& constants) { hold(constants, stage, free.length - until, state.v); });
    }
    state.phase_turns = turns;
    return affordable;
  }

  /// Changes the velocities by an impact, and reports it; false if it is one too many.
  template <class Stage>
  [[nodiscard]] bool strike(Stage& stage, Side side, double before, double after, double v_after) {
    motion::State<double>& state = stage.state;
    const double v_before = state.v;
    state.v = v_after, state.loose = {side, 0.0, after + 0.0};  // no negative zero
    stage.show({.kind = Kind::strike,
                .side = side,
                .time = stage.time(),
                .before = before,
                .after = state.loose.speed,
                .place = walls_.place(side),
                .turns = state.phase_turns,
                .main = {state.x, v_before, v_after}});
    return this->count_impact();
  }
  template <class Stage>
  void press(Stage& stage, Side side) const {
    motion::State<double>& state = stage.state;
    state.loose = {side, 0.0, 0.0, true};
    stage.show({.kind = Kind::press,
                .side = side,
                .time = stage.time(),
                .place = walls_.place(side),
                .main = {state.x, state.v, state.v}});
  }

  motion::Walls<double> walls_;
  motion::CarryingOscillator<double> carrying_;
};

}  // namespace clatter::stepping
