#pragma once

#include <algorithm>

#include "integrators/settle_forced.hpp"
#include "integrators/settle_unforced.hpp"

namespace clatter {

/// Runs forced motion for all of max_periods and looks for a repeat only then: what shortcuts are compared with.
template <Effects E>
[[nodiscard]] Observed settle_without_shortcut(Exact<double, E>& integrator, State<double> state,
                                               const TimePlan& plan) {
  constexpr auto longest = static_cast<std::int64_t>(RepeatFinder::longest);
  NoObserver nobody;
  RepeatFinder repeat(plan.tolerance);
  std::array<State<double>, RepeatFinder::longest> recent;
  for (std::int64_t section = 0;; ++section) {
    const auto settled = static_cast<double>(section);
    recent[static_cast<std::size_t>(section % longest)] = state;
    if (section >= plan.max_periods - 3 * longest) {
      if (const std::size_t n = repeat.add(state.x, state.v)) {
        const auto chosen = section - static_cast<std::int64_t>(repeat.lowest_of_last(n));
        return {Status::periodic, recent[static_cast<std::size_t>(chosen % longest)], static_cast<double>(n), settled,
                FoundBy::repetition};
      }
    }
    if (section == plan.max_periods)
      return {Status::aperiodic, state, static_cast<double>(plan.window), settled, FoundBy::nothing};
    const Outcome outcome = advance_to_section(integrator, state, state.periods, nobody);
    if (outcome != Outcome::completed) return {status_of(outcome), state, 0.0, settled, FoundBy::nothing};
  }
}

/// The time to observe of a scene that starts from `state`.
template <Effects E>
[[nodiscard]] Observed settle(Exact<double, E>& integrator, const State<double>& state, const Scene& scene) {
  if (scene.time.mode == Mode::transient)
    return {Status::transient, state, scene.time.duration / integrator.period(), 0.0, FoundBy::start};
  const bool forced = E.forcing != Forcing::none && scene.oscillator.forcing != 0;
  if (!forced) return FreeSearch<E>(integrator, scene).run(state);
  if constexpr (E.forcing != Forcing::none) {
    if (scene.all_effects) return settle_without_shortcut(integrator, state, scene.time);
    return SteadySearch<E>(integrator, scene).run(state);
  }
  return {};
}

}  // namespace clatter
