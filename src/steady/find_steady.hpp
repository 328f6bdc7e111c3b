#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "steady/coasting.hpp"
#include "steady/contact_at_section.hpp"
#include "steady/doubt.hpp"
#include "steady/forced_search.hpp"
#include "steady/free_search.hpp"
#include "steady/loose_search.hpp"
#include "steady/standing.hpp"
#include "stepping/integration.hpp"

namespace clatter::steady {

/// Runs forced motion until it repeats; repeats count from the stroboscopic section `from` on.
template <stepping::Integrator I>
[[nodiscard]] ObservedTime find_repetition(I& integrator, motion::State<double> state, const Scene& scene,
                                           const TimeSettings& time, std::int64_t from) {
  constexpr auto longest = static_cast<std::int64_t>(RepeatFinder::longest);
  PassageObserver watch(integrator.stops());
  RepeatFinder repeat(time.tolerance);
  Rests rests;
  const BeyondContact beyond_contact(scene, integrator.period());
  std::array<motion::State<double>, RepeatFinder::longest> recent;
  for (std::int64_t section = 0;; ++section) {
    const auto settled = static_cast<double>(section);
    const double log_area = watch.passage().log_area - 2 * integrator.constants().h * integrator.period();
    recent[static_cast<std::size_t>(section % longest)] = state;
    if (section >= from) {
      const auto [x, v, z, w] = beyond_contact({state.x, state.v});
      if (const std::size_t n = repeat.add(x, v, log_area, watch.passage().size)) {
        const auto chosen =
            section - static_cast<std::int64_t>(repeat.first_of_last(n, BeginsBefore(integrator.constants().f)));
        return repeated(recent[static_cast<std::size_t>(chosen % longest)], n, settled, section, rests);
      }
    }
    if (escapes(scene, state.x, state.v, integrator.phase(motion::State<double>{}))) return escape(state, settled);
    if constexpr (I::effects.friction)
      if (auto found = standing(integrator, scene, state, settled, settled)) return std::move(*found);
    if (section == time.max_periods) return aperiodic(state, settled, time, rests);
    watch.begin_section();
    const stepping::Outcome outcome = advance_to_section(integrator, state, state.periods, watch);
    if (outcome != stepping::Outcome::completed) return {status_of(outcome), state, 0.0, settled, FoundBy::nothing};
    rests.pass(watch.passage(), section);
  }
}

/// Forced motion by the shortcuts. Without stops its start tells the end, and a search, which keeps hundreds of
/// sections, needn't begin.
template <Effects E>
[[nodiscard]] ObservedTime find_by_shortcuts(stepping::Exact<double, E>& integrator, const motion::State<double>& state,
                                             const Scene& scene, const TimeSettings& time) {
  if constexpr (!E.stops())
    if (auto found = Coasting<E>(integrator, scene, time.tolerance).from(state, 0.0, 0.0)) return std::move(*found);
  return ForcedSearch<E>(integrator, scene, time).run(state);
}

/// Without a loose mass.
template <stepping::Integrator I>
[[nodiscard]] ObservedTime find_steady_between_stops(I& integrator, const motion::State<double>& state,
                                                     const Scene& scene, const TimeSettings& time,
                                                     const stepping::Integration& integration) {
  constexpr Effects E = I::effects;
  const bool forced = E.forcing != Forcing::none && is_driven(scene.oscillator);
  if (!forced) return FreeSearch(integrator, scene, time, integration.all_effects).run(state);
  if constexpr (E.forcing != Forcing::none) {
    const bool by_shortcuts = I::in_closed_form && integration.shortcuts && !integration.all_effects;
    if (integrator.is_rough() && !by_shortcuts) return find_repetition(integrator, state, scene, time, 0);
    if (integration.all_effects)
      return find_repetition(integrator, state, scene, time, last_look(scene.oscillator, time.max_periods));
    if constexpr (I::in_closed_form)
      if (integration.shortcuts) return find_by_shortcuts(integrator, state, scene, time);
    return find_repetition(integrator, state, scene, time, 0);
  }
  return {};
}

/// The time to observe of a scene that starts from `state`. General methods take no shortcut. Nor does a run with all
/// effects, which others are compared with: it simulates all of max_periods and looks for a repeat only at their end.
template <stepping::Integrator I>
[[nodiscard]] ObservedTime find_steady(I& integrator, const motion::State<double>& state, const Scene& scene,
                                       const TimeSettings& time, const stepping::Integration& integration) {
  constexpr Effects E = I::effects;
  if (time.mode == Mode::transient)
    return {Status::transient, state, time.duration / integrator.period(), 0.0, FoundBy::start};
  if constexpr (E.loose) {
    const std::int64_t from = integration.all_effects ? last_look(scene.oscillator, time.max_periods) : 0;
    const bool by_newton = I::in_closed_form && integration.shortcuts && !integration.all_effects;
    return HousingSearch<I>(integrator, scene, time, by_newton, from).run(state);
  } else {
    return find_steady_between_stops(integrator, state, scene, time, integration);
  }
}

}  // namespace clatter::steady
