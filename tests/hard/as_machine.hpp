#pragma once

#include "hard/machine.hpp"
#include "scene/scene.hpp"

namespace clatter::hard {

/// A scene in the simulator's terms.
[[nodiscard]] inline MachineScene as_machine(const Scene& scene) {
  const auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  return {.damping = oscillator.damping,
          .stiffness = oscillator.stiffness,
          .forcing = oscillator.forcing,
          .frequency = oscillator.frequency,
          .phase = start.phase,
          .load = oscillator.load,
          .friction = friction.kinetic,
          .static_friction = friction.static_level,
          .lower = stops.lower,
          .upper = stops.upper,
          .restitution_lower = stops.restitution_lower,
          .restitution_upper = stops.restitution_upper,
          .kappa_lower = stops.stiffness_lower,
          .kappa_upper = stops.stiffness_upper,
          .zeta_lower = stops.damping_lower,
          .zeta_upper = stops.damping_upper,
          .loose_mass = loose.ratio,
          .wall_lower = loose.lower,
          .wall_upper = loose.upper,
          .wall_R_lower = loose.restitution_lower,
          .wall_R_upper = loose.restitution_upper,
          .loose_load = loose.load,
          .x = start.displacement,
          .v = start.velocity,
          .z = loose.place,
          .w = loose.velocity};
}

}  // namespace clatter::hard
