#pragma once

#include "model/scene.hpp"
#include "model/shaking.hpp"
#include "model/units.hpp"
#include "observables/all.hpp"
#include "steady/time_settings.hpp"
#include "stepping/integration.hpp"

namespace clatter::point {

/// One point of a sweep: a scene, and all else that its results depend on.
struct Problem : Scene {
  steady::TimeSettings time;
  observables::Observe observe;
  stepping::Integration integration;
  Shaking shaking{};  ///< of the stops or the base, by which the displacement counts
  Units units{};      ///< of all its numbers
};

/// The limits of a run of a problem.
[[nodiscard]] inline stepping::Limits limits_of(const Problem& problem) {
  return limits_of(problem.time, problem.oscillator);
}

}  // namespace clatter::point
