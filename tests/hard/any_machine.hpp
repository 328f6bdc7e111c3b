#pragma once

#include "hard/any_carrying_scene.hpp"
#include "hard/any_sliding_scene.hpp"
#include "hard/machine.hpp"

namespace clatter::hard {

/// A random machine whose main mass has stops, friction, or a stiffness of any kind, and carries a loose mass.
[[nodiscard]] inline AnyScene any_machine(std::uint64_t index) {
  support::Random random(20701, index);
  AnyScene any = any_sliding_scene(index);
  auto& [oscillator, stops, start, shaking, friction, loose] = static_cast<Scene&>(any.scene);
  if (random.happens(0.5)) friction = {};
  loose = {.ratio = random.logarithmic(1e-2, 3),
           .restitution = any_restitution(random),
           .load = random.happens(0.4) ? 0 : random.uniform(-1, 1)};
  draw_walls(random, loose);
  draw_loose_start(random, loose);
  return any;
}
inline constexpr Kind machines{"machines", any_machine, 250};

/// The same in the simulator's terms.
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
          .wall_R_lower = loose.restitution,
          .wall_R_upper = loose.restitution,
          .loose_load = loose.load,
          .x = start.displacement,
          .v = start.velocity,
          .z = loose.place,
          .w = loose.velocity};
}

}  // namespace clatter::hard
