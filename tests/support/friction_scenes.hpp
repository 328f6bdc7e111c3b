#pragma once

#include <limits>

#include "support/runs.hpp"

namespace clatter::support {

/// A mass on its spring under dry friction, at rest at a place, without damping or stops.
[[nodiscard]] inline point::Problem rubbing_from(double place, const Friction& friction) {
  constexpr double none = std::numeric_limits<double>::infinity();
  point::Problem scene = scene_of({}, -none, none, 1);
  scene.friction = friction, scene.start.displacement = place;
  return scene;
}

/// A forced mass under dry friction between stops, whose steady motion sticks once a period.
[[nodiscard]] inline point::Problem rubbing_with_a_stick() {
  point::Problem scene = scene_of({.damping = 0.05, .forcing = 1, .frequency = 1.3}, -0.5, 0.5, 0.7);
  scene.friction = {0.2, 0.2};
  return scene;
}

}  // namespace clatter::support
