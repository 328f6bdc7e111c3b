#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "integrators/exact.hpp"
#include "integrators/repeat.hpp"
#include "integrators/return_map.hpp"

namespace clatter {

/// The time that is observed: where it begins, how long it is, and what the motion in it is.
template <class Number>
struct Observed {
  Status status = Status::unresolved;
  State<Number> from{};
  Number turns{};           ///< its length in forcing periods; without forcing in 2 pi
  double settled = 0.0;     ///< forcing periods simulated before, to find it
  bool standstill = false;  ///< nothing moves any more
};

[[nodiscard]] constexpr Status status_of(Outcome failure) {
  switch (failure) {
    case Outcome::event_budget:
      return Status::event_budget;
    case Outcome::not_finite:
      return Status::not_finite;
    default:
      return Status::unresolved;
  }
}

/// Runs to the next section.
template <class Number, Effects E, class Observer>
[[nodiscard]] Outcome advance_to_section(Exact<Number, E>& integrator, State<Number>& state, std::int64_t origin,
                                         Observer& observer) {
  const Outcome outcome = integrator.advance(state, Number(1), origin, observer);
  state.turns = 0;
  ++state.periods;
  return outcome;
}

/// Runs for a time in turns, starting at a section, under the eyes of an observer.
template <class Number, Effects E, class Observer>
[[nodiscard]] Outcome run_for(Exact<Number, E>& integrator, State<Number>& state, const Number& turns,
                              Observer& observer) {
  using std::floor;
  const std::int64_t origin = state.periods;
  Number left = floor(turns);
  const Number part = turns - left;
  while (left > 0) {
    const Outcome outcome = advance_to_section(integrator, state, origin, observer);
    if (outcome != Outcome::completed) return outcome;
    left -= 1;
  }
  return integrator.advance(state, part, origin, observer);
}

/// Runs forced motion until its state at the sections repeats.
template <class Number, Effects E>
[[nodiscard]] Observed<Number> settle_forced(Exact<Number, E>& integrator, State<Number> state, const TimePlan& plan) {
  NoObserver nobody;
  RepeatFinder repeat(plan.tolerance);
  std::array<State<Number>, RepeatFinder::longest> recent;
  for (std::int64_t k = 0;; ++k) {
    recent[static_cast<std::size_t>(k) % recent.size()] = state;
    if (const std::size_t n = repeat.add(static_cast<double>(state.x), static_cast<double>(state.v))) {
      const auto chosen = static_cast<std::size_t>(k) - repeat.lowest_of_last(n);
      return {Status::periodic, recent[chosen % recent.size()], Number(static_cast<double>(n)), static_cast<double>(k)};
    }
    if (k == plan.max_periods)
      return {Status::aperiodic, state, Number(static_cast<double>(plan.window)), static_cast<double>(k)};
    const Outcome outcome = advance_to_section(integrator, state, state.periods, nobody);
    if (outcome != Outcome::completed) return {status_of(outcome), state, Number(0), static_cast<double>(k)};
  }
}

/// Runs unforced motion until it returns to the same speed on the same stop, turns freely, or comes to stand still.
template <class Number, Effects E>
[[nodiscard]] Observed<Number> settle_unforced(Exact<Number, E>& integrator, State<Number> state, const Scene& scene) {
  const State<Number> start = state;
  ReturnMap returns(scene);
  for (std::int64_t k = 0;; ++k) {
    const auto settled = static_cast<double>(k);
    if (returns.stands_still(static_cast<double>(state.x), static_cast<double>(state.v),
                             integrator.holding_stop(state).has_value()))
      return {Status::periodic, state, Number(1), settled, true};
    if (k == scene.time.max_periods)
      return {Status::aperiodic, state, Number(static_cast<double>(scene.time.window)), settled};
    returns.begin_period(static_cast<double>(integrator.period()));
    const Outcome outcome = advance_to_section(integrator, state, state.periods, returns);
    if (outcome != Outcome::completed) return {status_of(outcome), state, Number(0), settled};
    if (integrator.holding_stop(state)) continue;
    const Number turns = returns.free_rotation() ? Number(1) : Number(Number(returns.period()) / integrator.period());
    if (turns > 0) return {Status::periodic, returns.conserved() ? start : state, turns, settled + 1};
  }
}

/// The time to observe of a scene that starts from `state`.
template <class Number, Effects E>
[[nodiscard]] Observed<Number> settle(Exact<Number, E>& integrator, const State<Number>& state, const Scene& scene) {
  if (scene.time.mode == Mode::transient)
    return {Status::transient, state, Number(Number(scene.time.duration) / integrator.period())};
  if constexpr (E.forcing == Forcing::none) return settle_unforced(integrator, state, scene);
  return settle_forced(integrator, state, scene.time);
}

}  // namespace clatter
