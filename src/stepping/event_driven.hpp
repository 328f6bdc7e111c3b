#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>

#include "motion/chatter.hpp"
#include "motion/walls.hpp"
#include "stepping/modes.hpp"

namespace clatter::stepping {

/// Event-driven integration: from event to event, chatter completed, rests released at their exact time. THE loop, of
/// every machine: the modes are those of the table in `modes.hpp`.
///
/// A `Method` computes flights: `fly(state, motion, anchor, horizon)` between stops, and `fly_within(constants, state,
/// motion, anchor, margins, horizon)` up to the first of some margins that falls to 0; with a loose mass
/// `fly_in_housing(state, motion, anchor, start, walls, horizon)` up to its next impact, and `carry(constants, state,
/// motion, anchor, pressing, horizon)` of both masses as one.
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
        walls_(this->constants(), scene.loose),
        soft_stops_(has_soft_stop(scene.stops)),
        low_{low_beside(scene, Side::lower, rule), low_beside(scene, Side::upper, rule)},
        chatter_accuracy_(rule.accuracy) {}

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section (the stroboscopic section of
  /// `motion::State`), and reports every arc and event with its time since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(State& state, const Number& end, std::int64_t origin, Observer& observer) {
    Stage<EventDriven, Observer> stage(*this, state, end, origin, observer);
    while (end - state.phase_turns > 2 * epsilon<Number>()) {
      this->report(state);
      modes::enter(*this, state);
      const Outcome outcome = run_mode(stage, Modes<EventDriven>());
      if (outcome != Outcome::completed) return outcome;
      if constexpr (E.soft) modes::keep_before_touch(*this, state);
    }
    state.phase_turns = end;
    return this->outcome_of(state);
  }

  /// The state in which a stop releases a mass from rest, in the first forcing period; nothing if it never does.
  [[nodiscard]] std::optional<State> released_from(Side side) const {
    const auto stop = motion::stop_at<Number>(this->stops(), side);
    const auto turns = modes::release_turns(*this, stop);
    if (!turns) return std::nullopt;
    State state;
    state.x = stop.position, state.from_stop = side, state.released = true, state.phase_turns = *turns;
    return state;
  }

  // For the modes.

  [[nodiscard]] Method& method() { return static_cast<Method&>(*this); }
  [[nodiscard]] const auto& walls() const { return walls_; }
  [[nodiscard]] bool has_soft_stops() const { return soft_stops_; }

  /// The position that the offset of the present flight counts from.
  [[nodiscard]] Number anchor(const State& state) const {
    return state.from_stop == Side::none ? state.x : motion::stop_at<Number>(this->stops(), state.from_stop).position;
  }
  /// The beginning of a flight; `released`: the acceleration if it begins with a release.
  template <class Constants>
  [[nodiscard]] motion::Motion<Number> motion(const Constants& constants, const State& state,
                                              const Number& released = Number(0)) const {
    const auto [sine, cosine] = this->phase(state);
    const Number offset = state.from_stop == Side::none ? Number(0) : state.offset;
    const Number displacement = constants.from_equilibrium(state.x, anchor(state), offset);
    const Number a = state.released ? released : constants.acceleration(displacement, state.v, sine);
    return {offset, state.x, state.v, a, sine, cosine};
  }
  [[nodiscard]] static Outcome outcome_at(const motion::Crossing<Number>& crossing) {
    if (crossing.resolved) return Outcome::completed;
    return Base::finite(crossing.motion.x) ? Outcome::unresolved : Outcome::not_finite;
  }

  /// The longest time after which a mass that a stop or a wall lets go, and that is back, may never have been let go:
  /// a force that touches zero differs from zero so long by no more than the rounding of its parts, some ulps of each.
  [[nodiscard]] Number shortest_hop() const {
    using std::sqrt;
    return 4 * sqrt(epsilon<Number>()) * 2 * pi<Number>() / this->constants().rate;
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
  /// Runs the first of some modes that has the state, up to its event or to the end of the stage.
  template <class Stage, class Mode, class... Others>
  [[nodiscard]] Outcome run_mode(Stage& stage, std::tuple<std::type_identity<Mode>, Others...>) {
    if (const auto has = Mode::has(*this, stage.state)) {
      if constexpr (requires { Mode::run(*this, stage); })
        return Mode::run(*this, stage);
      else if constexpr (requires { Mode::run(*this, stage, *has); })
        return Mode::run(*this, stage, *has);
      else
        return run(Mode{*this, stage.state}, *this, stage);
    }
    if constexpr (sizeof...(Others) > 0) return run_mode(stage, std::tuple<Others...>());
    return Outcome::completed;  // the last has any state
  }

  [[nodiscard]] static Number low_beside(const BasicScene<Number>& scene, Side side,
                                         const motion::ChatterRule<Number>& rule) {
    return E.rest ? Number(rule.low[index_of(side)] * motion::displacements_beside(scene, side)) : Number(0);
  }

  [[no_unique_address]] std::conditional_t<E.loose, motion::Walls<Number>, motion::NoWalls> walls_;
  bool soft_stops_;            ///< asked at each arc: general methods have one set of effects for soft and rigid stops
  std::array<Number, 2> low_;  ///< [stop]: rebounds of chatter that is summed aren't higher
  Number chatter_accuracy_;    ///< of a sum
};

}  // namespace clatter::stepping
