#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "motion/chatter.hpp"
#include "stepping/modes.hpp"

namespace clatter::stepping {

/// Event-driven integration: from event to event, chatter completed, rests released at their exact time. THE loop, of
/// every machine: the modes are those of the table in `modes.hpp`.
///
/// A `Method` computes flights: `fly(constants, state, motion, anchor, horizon)` between stops, and
/// `fly_within(constants, state, motion, anchor, margins, horizon)` up to the first of some margins that falls to 0.
/// With a loose mass it gives `beside(arc, start, load)`, the motion of that beside an arc of the main mass, its
/// contact `meet_wall(beside, walls, horizon)`, the end `let_go(arc, pressing, horizon)` of a time for which a wall
/// presses it, and `held_arc(constants, state, motion, anchor, length)` of a main mass that something holds.
template <class Method, class N, Effects E>
class EventDriven : public IntegratorBase<N, E> {
  using Base = IntegratorBase<N, E>;

 public:
  using Number = N;
  using State = motion::State<Number>;

  /// Looks for contacts with the stops in reach only.
  EventDriven(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits,
              const motion::ChatterRule<Number>& rule)
      : Base(scene, in_reach, limits),
        housing_(static_cast<const MainMass<N, E>&>(*this), scene),
        low_{low_beside(scene, Side::lower, rule), low_beside(scene, Side::upper, rule)},
        chatter_accuracy_(rule.accuracy) {}

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section (the stroboscopic section of
  /// `motion::State`), and reports every arc and event with its time since the section `origin`. Each knot of the force
  /// ends a stage, so that the mode is found anew there, also that of a loose mass, and a chatter which goes on is told
  /// by its impacts.
  template <class Observer>
  [[nodiscard]] Outcome advance(State& state, const Number& end, std::int64_t origin, Observer& observer) {
    if constexpr (E.stiffness)
      for (Number knot = this->next_knot(state.phase_turns); knot + knot_rounding<Number>() < end;
           knot = this->next_knot(state.phase_turns)) {
        const Outcome outcome = advance_in_piece(state, knot, origin, observer);
        if (outcome != Outcome::completed) return outcome;
      }
    return advance_in_piece(state, end, origin, observer);
  }

  /// The state in which a stop releases a mass from rest, in the first forcing period; nothing if it never does.
  [[nodiscard]] std::optional<State> released_from(Side side) const {
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
    const auto press = contact_force(this->constants(), stop, this->phase(state));
    const Number rebound = -stop.into(state.v), &low = low_[index_of(stop.side)];
    if constexpr (E.friction)
      if (this->is_rough())
        return rubbing_chatter_time(this->constants(), stop, press, this->slips().kinetic, this->slips().static_level,
                                    rebound, low, chatter_accuracy_);
    return motion::chatter_time(this->constants(), stop, press, rebound, low, chatter_accuracy_);
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
  std::array<Number, 2> low_;  ///< [stop]: rebounds of chatter that is summed aren't higher
  Number chatter_accuracy_;    ///< of a sum
};

}  // namespace clatter::stepping
