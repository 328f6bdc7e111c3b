#pragma once

#include "hard/any_machine.hpp"

namespace clatter::hard {

/// Lets the loose mass of a machine rub on its housing, by a force that is small beside the others to one that holds it
/// for good; at times with a static level above.
inline void draw_loose_friction(support::Random& random, LooseMass& loose) {
  loose.friction = loose.ratio * random.logarithmic(1e-2, 3);
  loose.friction_static = loose.friction * (random.happens(0.5) ? 1 : random.uniform(1, 2));
  if (random.happens(0.1)) loose.friction = 0;
}

/// A machine whose loose mass rubs on its housing.
[[nodiscard]] inline AnyScene any_rubbing_machine(std::uint64_t index) {
  support::Random random(20711, index);
  AnyScene any = any_machine(index);
  draw_loose_friction(random, any.scene.loose);
  return any;
}

/// The same without stops and friction of the main mass.
[[nodiscard]] inline AnyScene any_rubbing_scene(std::uint64_t index) {
  support::Random random(20712, index);
  AnyScene any = any_carrying_scene(index);
  draw_loose_friction(random, any.scene.loose);
  return any;
}

/// Lets one wall be soft, or both.
inline void draw_soft_walls(support::Random& random, LooseMass& loose) {
  const bool both = random.happens(0.6), upper = random.happens(0.5);
  if (both || !upper) loose.stiffness_lower = random.logarithmic(0.3, 3000);
  if (both || upper) loose.stiffness_upper = random.logarithmic(0.3, 3000);
  if (random.happens(0.7)) loose.damping_lower = random.happens(0.2) ? 1 : random.uniform(0, 2);
  if (random.happens(0.7)) loose.damping_upper = random.uniform(0, 0.6);
}
/// A machine whose loose mass meets soft walls, and half of the time rubs on its housing.
[[nodiscard]] inline AnyScene any_soft_walled_machine(std::uint64_t index) {
  support::Random random(20713, index);
  AnyScene any = random.happens(0.5) ? any_rubbing_machine(index) : any_machine(index);
  draw_soft_walls(random, any.scene.loose);
  return any;
}

}  // namespace clatter::hard
