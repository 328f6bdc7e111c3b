#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "point/problem.hpp"
#include "support/random.hpp"

namespace clatter::support {

/// A random scene with soft stops, or a soft and a rigid one, drawn by its index alone: any spring, damping and force,
/// stops from weak to stiff and from undamped to overdamped. A tenth starts inside a stop.
[[nodiscard]] inline point::Problem soft_scene(std::uint64_t index) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Random random(50251, index);
  point::Problem scene;
  Oscillator& o = scene.oscillator;
  o.damping = random.happens(0.2) ? 0 : random.happens(0.8) ? random.uniform(0, 0.5) : random.uniform(0.5, 2);
  o.forcing = random.happens(0.1) ? 0 : random.uniform(-2, 2);
  o.frequency = random.logarithmic(0.3, 4), o.load = random.happens(0.5) ? 0 : random.uniform(-1, 1);
  o.stiffness = random.happens(0.5) ? 1 : random.happens(0.3) ? 0 : random.uniform(-1, 3);
  Stops& stops = scene.stops;
  stops.lower = -random.uniform(0.05, 1), stops.upper = random.uniform(0.05, 1);
  const auto any_stiffness = [&] {
    return random.happens(0.2) ? std::max(0.0, -o.stiffness) + random.uniform(0.01, 0.5) : random.logarithmic(2, 1e4);
  };
  const auto any_damping = [&] {
    return random.happens(0.3) ? 0 : random.happens(0.8) ? random.uniform(0, 1) : random.uniform(1, 3);
  };
  stops.stiffness_lower = any_stiffness(), stops.damping_lower = any_damping();
  stops.stiffness_upper = stops.stiffness_lower, stops.damping_upper = stops.damping_lower;
  const bool unequal = random.happens(0.5);
  if (unequal) stops.stiffness_upper = any_stiffness(), stops.damping_upper = any_damping();
  if (unequal && random.happens(0.3)) stops.stiffness_upper = none, stops.restitution_upper = random.uniform(0.2, 1);
  if (o.stiffness > 0 && random.happens(0.2)) stops.upper = none;
  scene.start = {0, random.uniform(-2, 2), random.uniform(0, 6)};
  if (random.happens(0.1)) scene.start.displacement = stops.lower - random.uniform(0, 0.05);
  scene.time.mode = steady::Mode::transient, scene.time.duration = random.uniform(5, 20);
  return scene;
}

}  // namespace clatter::support
