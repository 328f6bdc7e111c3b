#pragma once

#include <cstdint>

#include "support/loose_scenes.hpp"
#include "support/random.hpp"

namespace clatter::support {

/// A machine of moderate numbers: a loose mass, at times with friction, in a main mass with rigid or soft stops, at
/// times with friction, on a spring or without one.
[[nodiscard]] inline point::Problem random_machine(std::uint64_t index) {
  Random random(20811, index);
  point::Problem scene = loose_scene(random.logarithmic(0.03, 1), random.logarithmic(0.02, 0.3), 1,
                                     random.uniform(0.5, 2), random.uniform(0.15, 1), random.uniform(0.2, 0.9));
  if (random.happens(0.3)) scene.oscillator.stiffness = random.happens(0.5) ? 0 : -0.3;
  if (random.happens(0.3)) scene.oscillator.load = random.uniform(-0.5, 0.5);
  scene.start.displacement = random.uniform(-0.2, 0.2), scene.start.velocity = random.uniform(-0.5, 0.5);
  scene.start.phase = random.uniform(0, 6);
  scene.loose.place = random.uniform(0.9 * scene.loose.lower, 0.9 * scene.loose.upper);
  scene.loose.velocity = random.happens(0.3) ? 0 : random.uniform(-0.5, 0.5);
  if (random.happens(0.4)) scene.loose.load = random.uniform(-1, 1);
  if (random.happens(0.6)) {
    scene.loose.friction = scene.loose.ratio * random.logarithmic(0.03, 1);
    scene.loose.friction_static = scene.loose.friction * (random.happens(0.5) ? 1 : random.uniform(1, 1.5));
  }
  if (random.happens(0.6)) {
    const double kinetic = random.logarithmic(0.02, 0.6);
    scene.friction = {kinetic, kinetic * (random.happens(0.5) ? 1 : random.uniform(1, 1.5))};
  }
  if (random.happens(0.8)) {
    const double near = random.uniform(0.3, 1), far = random.happens(0.5) ? near : 2 * near;
    scene.stops = {-near, far, random.uniform(0.2, 0.9), random.uniform(0.2, 0.9)};
    if (random.happens(0.4)) scene.stops.stiffness_lower = random.logarithmic(3, 300);
    if (random.happens(0.4)) scene.stops.stiffness_upper = random.logarithmic(3, 300);
    if (random.happens(0.5)) scene.stops.damping_lower = scene.stops.damping_upper = random.uniform(0, 0.5);
  }
  return scene;
}

}  // namespace clatter::support
