#pragma once

#include <optional>

#include "scene/creep.hpp"
#include "steady/observed_time.hpp"
#include "stepping/integrator.hpp"

namespace clatter::steady {

/// The end of a search at a mass that dry friction holds for good, or that creeps to the edge of the places at which it
/// does: after `settled` forcing periods, of which, with those of attempts, `simulated` were run. One that creeps is
/// observed where it creeps to, which is the same for all starts.
template <stepping::Integrator I>
[[nodiscard]] std::optional<ObservedTime> standing(const I& integrator, const Scene& scene,
                                                   const motion::State<double>& state, double settled,
                                                   double simulated) {
  if (!integrator.is_rough()) return std::nullopt;
  if (integrator.sticks_for_good(state))
    return ObservedTime{Status::periodic, state, 1.0, simulated, FoundBy::standstill, settled};
  const auto edge = creeps_to(scene, state.x, state.v, integrator.phase(motion::State<double>{}));
  if (!edge) return std::nullopt;
  motion::State<double> limit;
  limit.x = edge->x, limit.periods = state.periods;
  return ObservedTime{Status::creeping, limit, 1.0, simulated, FoundBy::creep};
}

}  // namespace clatter::steady
