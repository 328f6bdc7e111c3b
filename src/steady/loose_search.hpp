#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "motion/walls.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/effects.hpp"
#include "steady/contact_at_section.hpp"
#include "steady/observed_time.hpp"
#include "steady/passage_observer.hpp"
#include "steady/repeat.hpp"
#include "steady/time_settings.hpp"
#include "stepping/run.hpp"

namespace clatter::steady {

/// Whether a loose mass is proved to leave its housing for ever through the side without a wall: no force brings it
/// back, and its displacement y keeps clear of all places at which the main mass can carry the wall that there is.
[[nodiscard]] inline bool loose_mass_escapes(const Scene& scene, const motion::State<double>& state,
                                             const SineCosine<double>& phase) {
  const LooseMass& loose = scene.loose;
  const Oscillator& o = scene.oscillator;
  const bool is_open_above = std::isinf(loose.upper), is_open_below = std::isinf(loose.lower);
  if (state.loose.pressed || (!is_open_above && !is_open_below)) return false;
  const auto [z, w] = motion::place_in_housing(state, loose);
  const double y = state.loose.wall == Side::none ? state.loose.place : z + state.x,
               v = state.loose.wall == Side::none ? state.loose.speed : w + state.v;
  const double middle = equilibrium_of(o);
  const PhaseState main{state.x - middle, state.v, phase.sine, phase.cosine};
  constexpr double for_ever = std::numeric_limits<double>::infinity();
  const bool in_a_stop = soft_stop_beyond(scene.stops, state.x) != Side::none;  // which has stored energy
  const double far = in_a_stop                      ? for_ever
                     : has_events_of_its_own(scene) ? displacement_bound_through_impacts(o, main, for_ever)
                                                    : displacement_bound(o, main, for_ever, 0.0);
  const auto departs = [&](int sign, double wall) {  // the wall on the other side, which may be at infinity, too
    if (!(sign * loose.load >= 0) || !(sign * v > 0 || (sign * loose.load > 0 && v == 0))) return false;
    return std::isinf(wall) || sign * (y - middle - wall) > far;
  };
  return (is_open_above && departs(1, loose.lower)) || (is_open_below && departs(-1, loose.upper));
}

/// Runs forced motion with a loose mass until it repeats: its displacement and velocity, and the place of the loose
/// mass in its housing with z'. Repeats count from the stroboscopic section `from` on. No shortcut is proved of it.
template <stepping::Integrator I>
[[nodiscard]] ObservedTime find_repetition_in_housing(I& integrator, motion::State<double> state, const Scene& scene,
                                                      const TimeSettings& time, std::int64_t from) {
  constexpr auto longest = static_cast<std::int64_t>(RepeatFinder::longest);
  PassageObserver watch(integrator.stops());
  BasicRepeatFinder<3> repeat(time.tolerance);
  std::array<motion::State<double>, RepeatFinder::longest> recent;
  const BeyondContact beyond_contact(scene, integrator.period());
  const SineCosine<double> phase = integrator.phase(motion::State<double>{});
  for (std::int64_t section = 0;; ++section) {
    const auto settled = static_cast<double>(section);
    const double log_volume = watch.passage().log_area - 2 * integrator.constants().h * integrator.period();
    recent[static_cast<std::size_t>(section % longest)] = state;
    if (section >= from) {
      const auto place = motion::place_in_housing(state, scene.loose);
      const auto [x, v, z, w] = beyond_contact({state.x, state.v, place.z, place.w});
      if (const std::size_t n =
              repeat.add(x, {v, z, w}, log_volume, {watch.passage().size, watch.passage().loose_size})) {
        const auto chosen =
            section - static_cast<std::int64_t>(repeat.first_of_last(n, BeginsBefore(scene.oscillator.forcing)));
        ObservedTime found{Status::periodic, recent[static_cast<std::size_t>(chosen % longest)], static_cast<double>(n),
                           settled, FoundBy::repetition};
        found.settling = settled;
        return found;
      }
    }
    if (loose_mass_escapes(scene, state, phase)) return escape(state, settled);
    if (section == time.max_periods)
      return {Status::aperiodic, state, static_cast<double>(time.window), settled, FoundBy::nothing};
    watch.begin_section();
    const stepping::Outcome outcome = advance_to_section(integrator, state, state.periods, watch);
    if (outcome != stepping::Outcome::completed) return {status_of(outcome), state, 0.0, settled, FoundBy::nothing};
  }
}

}  // namespace clatter::steady
