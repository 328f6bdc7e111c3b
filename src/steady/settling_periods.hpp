#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "motion/walls.hpp"
#include "steady/contact_at_section.hpp"
#include "steady/observed_time.hpp"
#include "steady/passage_observer.hpp"
#include "steady/time_settings.hpp"
#include "stepping/run.hpp"

namespace clatter::steady {

/// Forcing periods after which forced motion from `start` stays within `distance` of the periodic one that it was found
/// to end in: from that stroboscopic section on, no state is further from that of the periodic motion at the same
/// section, relative to the larger of its |x| and |v|, velocities being counted in units of `velocity`. NaN if it has
/// none, or isn't that close after max_periods. A loose mass has to be as near to its own, by |z| and |z'|.
template <stepping::Integrator I>
[[nodiscard]] double settling_periods(I integrator, motion::State<double> start, const ObservedTime& found,
                                      const TimeSettings& time, double distance, double velocity, const Scene& scene) {
  constexpr double never = std::numeric_limits<double>::quiet_NaN();
  if (!(found.status == Status::periodic || found.status == Status::grazing) || !std::isfinite(found.settling))
    return never;
  auto watch =
      passage_observer(integrator, scene);  // as in the search: another observer would compile the integrator anew
  const auto advance = [&](motion::State<double>& state) {
    return advance_to_section(integrator, state, state.periods, watch) == stepping::Outcome::completed;
  };
  std::vector<motion::State<double>> cycle = found.sections;
  if (cycle.empty()) cycle.push_back(found.from);
  while (static_cast<double>(cycle.size()) < found.turns) {
    motion::State<double> next = cycle.back();
    if (!advance(next)) return never;
    cycle.push_back(next);
  }
  const auto period = static_cast<std::int64_t>(cycle.size());
  const BeyondContact beyond_contact(scene, integrator.period());
  const auto numbers_of = [&](const motion::State<double>& state) -> SectionNumbers {
    if constexpr (I::effects.loose) {
      const auto [z, w] = motion::place_in_housing(state, scene.loose);
      return beyond_contact({state.x, state.v, z, w});
    }
    return beyond_contact({state.x, state.v});
  };
  const auto is_near = [&](const motion::State<double>& state) {
    const std::int64_t ahead = (state.periods - found.from.periods) % period;
    const SectionNumbers steady = numbers_of(cycle[static_cast<std::size_t>(ahead < 0 ? ahead + period : ahead)]);
    const auto [x, v, z, w] = numbers_of(state);
    const auto are_near = [&](double place, double speed, double steady_place, double steady_speed) {
      const double most = distance * std::max(std::abs(steady_place), velocity * std::abs(steady_speed));
      return std::abs(place - steady_place) <= most && velocity * std::abs(speed - steady_speed) <= most;
    };
    return are_near(x, v, steady.x, steady.v) && (!I::effects.loose || are_near(z, w, steady.z, steady.w));
  };
  const auto last =
      static_cast<std::int64_t>(std::min(std::ceil(found.settling), static_cast<double>(time.max_periods)));
  std::int64_t settled = is_near(start) ? 0 : 1;  // sections up to the last one that is too far away
  while (start.periods < last) {
    if (!advance(start)) return never;
    if (!is_near(start)) settled = start.periods + 1;
  }
  return settled > last ? never : static_cast<double>(settled);
}

}  // namespace clatter::steady
