#pragma once

#include <cmath>
#include <limits>

#include "hard/any_scene.hpp"
#include "hard/tally.hpp"

namespace clatter::hard {

/// The numbers of a scene in units of time in which its spring has k = 1, in which the program computes it.
inline void give_spring(Scene& scene, double& duration, double k) {
  const double rate = std::sqrt(k);
  auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  for (double* value : {&oscillator.damping, &oscillator.frequency, &start.velocity, &loose.velocity}) *value /= rate;
  for (double* value : {&oscillator.forcing, &oscillator.load, &loose.load}) *value /= k;
  duration *= rate;
}

/// Walls as far from the middle on both sides, unequal ones, or one.
inline void draw_walls(support::Random& random, LooseMass& loose) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double kind = random.uniform(0, 1), near = random.logarithmic(1e-3, 3), far = random.logarithmic(1e-3, 3);
  loose.lower = -near, loose.upper = kind < 0.5 ? near : far;
  if (kind > 0.95) loose.lower = near, loose.upper = near + far;
  if (kind > 0.75 && kind < 0.85) loose.lower = -none;
  if (kind > 0.85 && kind < 0.95) loose.upper = none;
}

/// A start between the walls, or on one of them: at rest, moving in or moving out.
inline void draw_loose_start(support::Random& random, LooseMass& loose) {
  const bool has_lower = std::isfinite(loose.lower), has_upper = std::isfinite(loose.upper);
  const double low = has_lower ? loose.lower : loose.upper - 3, high = has_upper ? loose.upper : loose.lower + 3;
  loose.place = random.uniform(low, high);
  loose.velocity = random.happens(0.2) ? 0 : random.sign() * random.logarithmic(1e-2, 3);
  if (random.happens(0.75)) return;
  const bool on_upper = has_upper && (!has_lower || random.happens(0.5));
  loose.place = on_upper ? loose.upper : loose.lower;
  if (random.happens(0.3)) loose.velocity = 0;
}

/// Starts at which something is exactly 0, or a scale is far from the others.
inline void make_special(support::Random& random, Scene& scene) {
  auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  const double kind = random.uniform(0, 1);
  const bool on_upper = std::isfinite(loose.upper) && (!std::isfinite(loose.lower) || random.happens(0.5));
  if (kind < 0.3) {  // on a wall, at rest with the main mass: the wall doesn't press at the start, but from then on
    if (oscillator.forcing == 0) oscillator.forcing = 1;
    start = {0, 0, 0}, oscillator.load = loose.load = loose.velocity = 0;
    loose.place = on_upper ? loose.upper : loose.lower;
  } else if (kind < 0.5) {  // it stands until a wall meets it
    loose.load = 0, loose.velocity = -start.velocity;
  } else if (kind < 0.6) {  // the main mass is in equilibrium until it is struck
    oscillator.forcing = 0, oscillator.load = start.displacement = start.velocity = 0;
    if (loose.velocity == 0) loose.velocity = 0.5;
  } else if (kind < 0.8) {
    loose.ratio = random.happens(0.5) ? random.logarithmic(1e-15, 1e-9) : random.logarithmic(10, 1e6);
  } else {
    const double size = random.happens(0.5) ? 1e-9 : 1e3;
    loose.lower *= size, loose.upper *= size, loose.place *= size;
  }
}

/// A random scene with a loose mass: force, damping and start of the main mass as `any_scene` draws them, no stops, a
/// spring of any stiffness. A loose load brings the mass back to its only wall.
[[nodiscard]] inline AnyScene any_carrying_scene(std::uint64_t index) {
  AnyScene any = any_scene(index);
  support::Random random(20610, index);
  constexpr double none = std::numeric_limits<double>::infinity();
  Scene& scene = any.scene;
  auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  stops = {-none, none, 1, 1};
  start = any_start(random, {-1, 1, 1, 1});
  oscillator.stiffness = 1;
  loose.ratio = random.logarithmic(1e-4, 3);
  draw_walls(random, loose);
  loose.restitution_lower = loose.restitution_upper = any_restitution(random);
  draw_loose_start(random, loose);
  const bool has_both = std::isfinite(loose.lower) && std::isfinite(loose.upper);
  if (random.happens(0.4)) loose.load = random.uniform(-1.5, 1.5);
  if (!has_both) loose.load = random.logarithmic(0.05, 1.5) * (std::isfinite(loose.upper) ? 1 : -1);
  if (index % 8 == 7) make_special(random, scene);
  const double kind = random.uniform(0, 1);
  if (kind > 0.6)
    give_spring(scene, any.duration, kind < 0.8 ? random.logarithmic(1e-6, 1) : random.logarithmic(1, 100));
  any.scene.time.duration = any.duration;
  return any;
}

}  // namespace clatter::hard
