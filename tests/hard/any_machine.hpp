#pragma once

#include "hard/any_carrying_scene.hpp"
#include "hard/any_sliding_scene.hpp"

namespace clatter::hard {

/// A random machine whose main mass has stops, friction, or a stiffness of any kind, and carries a loose mass.
[[nodiscard]] inline AnyScene any_machine(std::uint64_t index) {
  support::Random random(20701, index);
  AnyScene any = any_sliding_scene(index);
  auto& [oscillator, stops, start, shaking, friction, loose] = static_cast<Scene&>(any.scene);
  if (random.happens(0.5)) friction = {};
  loose = {.ratio = random.logarithmic(1e-2, 3),
           .restitution_lower = any_restitution(random),
           .restitution_upper = any_restitution(random),
           .load = random.happens(0.4) ? 0 : random.uniform(-1, 1)};
  draw_walls(random, loose);
  draw_loose_start(random, loose);
  return any;
}

}  // namespace clatter::hard
