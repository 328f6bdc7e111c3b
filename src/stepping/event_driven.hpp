#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "motion/chatter.hpp"
#include "stepping/any_observer.hpp"
#include "stepping/modes.hpp"
#include "stepping/stop_frame.hpp"

namespace clatter::stepping {

/// Event-driven integration: from event to event, chatter completed, rests released at their exact time. THE loop, of
/// every machine: the modes are those of the table in `modes.hpp`.
///
/// A `Method` computes flights: `fly(constants, state, motion, anchor, horizon)` between stops, and
/// `fly_within(constants, state, motion, anchor, margins, horizon)` up to the first of some margins that falls to 0.
/// With a loose mass it gives `beside(arc, start, load)`, the motion of that beside an arc of the main mass, its
/// contact `meet_wall(beside, walls, horizon)`, the end `let_go(arc, pressing, horizon)` of a time for which a wall
/// presses it, and `held_arc(constants, state, motion, anchor, length)` of a main mass that something holds.
template <class Method, class Arcs, class N, Effects E>
class EventDriven : public IntegratorBase<N, E> {
  using Base = IntegratorBase<N, E>;

 public:
  using Number = N;
  using State = motion::State<Number>;
  using Any = ObserverOf<Arcs, E>;
  /// Whether observers are seen through a pointer. The loops of rigid stops alone are so short that this would cost.
  static constexpr bool is_long = E.stiffness || !std::is_same_v<Number, double>;
  static_assert(is_long || !E.own_motion);

  /// Looks for contacts with the stops in reach only.
  EventDriven(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits,
              const motion::ChatterRule<Number>& rule)
      : Base(scene, in_reach, limits),
        housing_(static_cast<const MainMass<N, E>&>(*this), scene),
        low_{low_beside(scene, Side::lower, rule), low_beside(scene, Side::upper, rule)},
        chatter_accuracy_(rule.accuracy) {
    if constexpr (E.own_motion)
      if (move_by_themselves(in_reach)) frames_.emplace(scene, in_reach, rule);
  }

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section (the stroboscopic section of
  /// `motion::State`), and reports every arc and event with its time since the section `origin`. Each knot of the force
  /// ends a stage, so that the mode is found anew there, also that of a loose mass, and a chatter which goes on is told
  /// by its impacts.
  template <class Observer>
  [[nodiscard]] Outcome advance(State& state, const Number& end, std::int64_t origin, Observer& observer) {
    if constexpr (is_long) {
      Any any(observer);
      return advance_long(state, end, origin, any);
    } else {
      return advance_in_piece(state, end, origin, observer);
    }
  }
  /// The same, compiled once for all observers: `long_loop.hpp` has it.
  [[nodiscard]] Outcome advance_long(State& state, const Number& end, std::int64_t origin, Any& observer);

  /// The state in which a stop releases a mass from rest, in the first forcing period; nothing if it never does.
  [[nodiscard]] std::optional<State> released_from(Side side) const {
    if constexpr (E.own_motion)
      if (frames_) return released_from_moving(side);
    const auto stop = motion::stop_at<Number>(this->stops(), side);
    State state;
    state.x = stop.position, state.from_stop = side;
    for (Number knot(0); knot < 1; knot = this->next_knot(knot)) {
      if (const auto turns = modes::release_turns(*this, stop, knot)) {
        state.released = true, state.phase_turns = *turns;
        return state;
      }
      if (E.stiffness && modes::is_releasing_knot(*this, state, knot)) {
        state.phase_turns = knot;
        return state;
      }
    }
    return std::nullopt;
  }

  // For the modes.

  [[nodiscard]] Method& method() { return static_cast<Method&>(*this); }
  static constexpr bool carries = false;
  [[nodiscard]] bool loses() const requires(E.loose) { return housing_.loses; }
  [[nodiscard]] const auto& held_constants(bool with_loose) const requires(E.loose) {
    return housing_.held(with_loose);
  }
  /// Calls `function(loop)` with that of both masses as one.
  template <class Function>
  decltype(auto) as_one(Function&& function) requires(E.loose) {
    return housing_.carrying.with_mass([&]<class Mass>(const Mass& mass) {
      WithMass<EventDriven, Mass, true> both(*this, mass, housing_.walls);
      return function(both);
    });
  }
  /// Calls `function(loop)` with that of a main mass beside which the loose one flies, or slides to a side.
  template <class Function>
  decltype(auto) beside(Side towards, Function&& function) requires(E.loose) {
    using Beside = WithMass<EventDriven, MainMass<N, E>, false>;
    const bool slides = housing_.walls.is_rough();
    const MainMass<N, E>& mass = slides ? housing_.slide(towards).mass : static_cast<const MainMass<N, E>&>(*this);
    Beside loop(*this, mass, slides ? housing_.slide(towards).walls : housing_.walls);
    return function(loop);
  }
  /// Runs the mode of both masses as one.
  template <class Stage>
  [[nodiscard]] Outcome run_carrying(Stage& stage) requires(E.loose) {
    return as_one([&](auto& both) { return modes::run_first(both, stage); });
  }

  [[nodiscard]] static Outcome outcome_at(const motion::Crossing<Number>& crossing) {
    if (crossing.resolved) return Outcome::completed;
    return Base::finite(crossing.motion.x) ? Outcome::unresolved : Outcome::not_finite;
  }

  /// The time that the rest of a chatter takes, in which the mass has just left a stop; nothing if it isn't summed.
  [[nodiscard]] std::optional<Number> chatter_time(const State& state, const motion::Stop<Number>& stop) const {
    return chatter_time_of(*this, low_[index_of(stop.side)], state, stop);
  }
  /// The same of another main mass, rebounds of which aren't higher than `low`.
  template <class Mass>
  [[nodiscard]] std::optional<Number> chatter_time_of(const Mass& mass, const Number& low, const State& state,
                                                      const motion::Stop<Number>& stop) const {
    const auto press = contact_force(mass.constants(), stop, mass.phase(state));
    const Number rebound = -stop.into(state.v);
    if constexpr (E.friction)
      if (mass.is_rough())
        return rubbing_chatter_time(mass.constants(), stop, press, mass.slips().kinetic, mass.slips().static_level,
                                    rebound, low, chatter_accuracy_);
    return motion::chatter_time(mass.constants(), stop, press, rebound, low, chatter_accuracy_);
  }

 private:
  /// The same up to a phase, before which the force has no knot; but it may begin at one, as a section may be one.
  template <class Observer>
  [[nodiscard]] Outcome advance_in_piece(State& state, const Number& end, std::int64_t origin, Observer& observer) {
    Stage<EventDriven, Observer> stage(*this, state, end, origin, observer);
    if constexpr (E.stiffness)
      if (this->is_at_knot(state.phase_turns)) {
        state.chatters = false;
        if (state.loose.pressed) state.loose.may_part = true;
      }
    while (end - state.phase_turns > 2 * epsilon<Number>()) {
      this->report(state);
      modes::enter(*this, state);
      const Outcome outcome = run_mode(stage);
      if (outcome != Outcome::completed) return outcome;
      if constexpr (E.soft) modes::keep_before_touch(*this, state);
    }
    state.phase_turns = end;
    return this->outcome_of(state);
  }

  /// The same as `released_from` a stop that moves by itself.
  [[nodiscard]] std::optional<State> released_from_moving(Side side) const {
    const auto& frame = frames_->of(side);
    const auto turns = modes::release_turns(InFrame(*this, frame), frame.stop(), Number(0));
    if (!turns) return std::nullopt;
    State state;
    state.x = frame.stop().position, state.from_stop = side, state.released = true, state.phase_turns = *turns;
    frames_->leave(state);
    return state;
  }
  /// The same as `advance` between stops that move by themselves.
  template <class Observer>
  [[nodiscard]] Outcome advance_in_frames(State& state, const Number& end, std::int64_t origin, Observer& observer) {
    frames_->enter(state);
    auto outcome = Outcome::completed;
    while (outcome == Outcome::completed && end - state.phase_turns > 2 * epsilon<Number>()) {
      this->report(state);
      outcome = run_in_frame(state, end, origin, observer);
    }
    if (outcome == Outcome::completed) state.phase_turns = end;
    frames_->leave(state);
    return outcome == Outcome::completed ? this->outcome_of(state) : outcome;
  }
  /// Runs the mode that a state is in, as the stop sees it that it has left last.
  template <class Observer>
  [[nodiscard]] Outcome run_in_frame(State& state, const Number& end, std::int64_t origin, Observer& observer) {
    const auto& frame = frames_->of(state.from_stop);
    InFrame loop(*this, frame);
    SeenFromBase seen(frame, observer);
    Stage<EventDriven, decltype(seen)> stage(*this, state, end, origin, seen);
    modes::enter(loop, state);
    const bool flies = state.within == Side::none && !state.chatters && !loop.holding_stop(state);
    const Outcome outcome = flies ? fly_in_frame(loop, stage, observer) : modes::run_first(loop, stage);
    modes::keep_before_touch(InFrame(*this, frames_->of(state.from_stop)), state);
    return outcome;
  }
  /// A flight to the first contact, with the stop that it began on or with another one.
  template <class Loop, class StageOf, class Observer>
  [[nodiscard]] Outcome fly_in_frame(Loop& loop, StageOf& stage, Observer& observer) {
    State& state = stage.state;
    const Between<Loop> mode{loop, state};
    const auto& constants = loop.constants();
    const Number horizon = stage.time_left();
    const motion::Motion<Number> start = loop.motion(constants, state);
    const auto flight = loop.fly(constants, state, start, loop.anchor(state), horizon);
    if (!flight.crossing.resolved) return outcome_at(flight.crossing);
    if (mode.is_none(flight.crossing)) return mode.wait(stage, flight.crossing);
    const motion::Crossing<Number> other = meet_other(state, flight.crossing.elapsed);
    if (!other.resolved) return outcome_at(other);
    stage.show(flight.arc, other.elapsed);
    if (other.side == Side::none) {
      const Flown<Number, std::remove_cvref_t<decltype(constants)>> flown{constants, start, flight.crossing, horizon,
                                                                          0};
      return end_main(mode, stage, flown);
    }
    stage.pass(other.elapsed);
    state.x = other.motion.x, state.v = other.motion.v, state.released = false;
    state.from_stop = other.side, state.offset = 0;
    const auto& frame = frames_->of(other.side);
    InFrame there(*this, frame);
    SeenFromBase seen(frame, observer);
    Stage<EventDriven, decltype(seen)> stage_there(*this, state, stage.end, stage.origin(), seen);
    return laws::meet(there, stage_there, frame.stop());
  }
  /// The first contact of a flight within a time with a stop that it didn't begin on, as that sees it.
  [[nodiscard]] motion::Crossing<Number> meet_other(const State& state, const Number& horizon) {
    motion::Crossing<Number> first{0, Side::none, horizon, {}, 0, true};
    for (const Side side : {Side::lower, Side::upper}) {
      const auto& mass = frames_->of(side).mass();
      if (side == state.from_stop || !is_finite(frames_->of(side).stop().position)) continue;
      const State there = frames_->seen_from(side, state);
      const auto flight = method().fly_between(mass.stops(), mass.constants(), mass.motion(mass.constants(), there),
                                               there.x, first.elapsed);
      if (!flight.crossing.resolved) return flight.crossing;
      if (flight.crossing.side != Side::none) first = flight.crossing;
    }
    return first;
  }

  /// Runs the mode that the state is in, up to its event or to the end of the stage.
  template <class Stage>
  [[nodiscard]] Outcome run_mode(Stage& stage) {
    if constexpr (E.loose)
      return run_in_housing(stage);
    else
      return modes::run_first(*this, stage);
  }
  /// The same with a loose mass, which may begin to move with the main one.
  template <class Stage>
  [[nodiscard]] Outcome run_in_housing(Stage& stage) {
    State& state = stage.state;
    motion::LooseState<Number>& loose = state.loose;
    Side towards = Side::none;
    const bool has_soft_walls = housing_.walls.is_soft(Side::lower) || housing_.walls.is_soft(Side::upper);
    if (has_soft_walls) modes::find_soft_wall(housing_.walls, state);
    if (!loose.pressed && housing_.walls.is_rough()) {
      towards = modes::slides_to(*this, state);
      if (towards == Side::none) beside(opposite(loose.wall), [&](auto& alone) { laws::stop(alone, stage); });
    } else if (!loose.pressed) {
      beside(towards, [&](auto& alone) {
        if (modes::lies_pressed(alone, state)) laws::press(alone, stage, loose.wall, Number(0));
      });
    }
    if (has_soft_walls) enter_soft_wall(state, towards);
    if (loose.pressed) return run_carrying(stage);
    return beside(towards, [&](auto& alone) { return modes::run_first(alone, stage); });
  }

  /// Lets a loose mass that lies on a soft wall into it, if it is driven there.
  void enter_soft_wall(State& state, Side towards) {
    motion::LooseState<Number>& loose = state.loose;
    const bool lies = loose.place == 0 && loose.speed == 0 && !loose.pressed && !loose.within;
    if (!lies || !housing_.walls.is_soft(loose.wall)) return;
    const auto is_driven = [&](auto& alone) { return modes::into_wall(alone, loose.wall, state) > 0; };
    loose.within = loose.pushed = towards == Side::none ? beside(towards, is_driven) : towards == loose.wall;
  }

  [[nodiscard]] static Number low_beside(const BasicScene<Number>& scene, Side side,
                                         const motion::ChatterRule<Number>& rule) {
    return E.rest ? Number(rule.low[index_of(side)] * motion::displacements_beside(scene, side)) : Number(0);
  }

  [[no_unique_address]] std::conditional_t<E.loose, Housing<Number, E>, NoHousing> housing_;
  [[no_unique_address]] std::conditional_t<E.own_motion, std::optional<StopFrames<Number, E>>, NoStopFrames> frames_{};
  std::array<Number, 2> low_;  ///< [stop]: rebounds of chatter that is summed aren't higher
  Number chatter_accuracy_;    ///< of a sum
};

}  // namespace clatter::stepping
