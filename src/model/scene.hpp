#pragma once

#include <cmath>

#include "model/oscillator.hpp"
#include "model/stops.hpp"

namespace clatter {
inline namespace model {

/// The state at tau = 0.
struct Start {
  double displacement = 0.0;  ///< x0, between the stops
  double velocity = 0.0;      ///< v0
  double phase = 0.0;         ///< forcing phase at tau = 0, rad
};

/// An oscillator, its stops and its start: everything that the motion depends on.
struct Scene {
  Oscillator oscillator;
  Stops stops;
  Start start;
};

/// Whether the mirror image of each motion, half a forcing period later, is a motion too.
[[nodiscard]] inline bool is_symmetric(const Scene& scene) {
  const Stops& stops = scene.stops;
  const bool bounded = std::isfinite(stops.upper);
  const bool alike = stops.restitution_lower == stops.restitution_upper &&
                     stops.stiffness_lower == stops.stiffness_upper && stops.damping_lower == stops.damping_upper;
  return stops.lower == -stops.upper && (!bounded || alike) && scene.oscillator.load == 0;
}

}  // namespace model
}  // namespace clatter
