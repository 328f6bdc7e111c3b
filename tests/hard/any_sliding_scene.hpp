#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "hard/any_scene.hpp"
#include "hard/tally.hpp"

namespace clatter::hard {

/// A friction in units of a force: from next to nothing to more than holds the mass for good.
inline double any_kinetic(support::Random& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.05) return 0;
  if (kind < 0.10) return random.logarithmic(1e-12, 1e-3);
  if (kind < 0.15) return 1;  // as large as the force
  if (kind < 0.20) return 1 + random.sign() * random.logarithmic(1e-14, 1e-2);
  if (kind < 0.25) return random.logarithmic(1, 10);
  return random.uniform(0.01, 1);
}

/// The static level, in the same units, no less than the other.
inline double any_static_level(support::Random& random, double kinetic) {
  const double kind = random.uniform(0, 1);
  if (kinetic == 0) return random.logarithmic(1e-3, 2);
  if (kind < 0.5) return kinetic;
  if (kind < 0.6) return kinetic * (1 + random.logarithmic(1e-12, 1e-3));
  if (kind < 0.7) return kinetic * random.logarithmic(1.5, 30);
  return kinetic * random.uniform(1, 1.5);
}

/// Softens a stop, moderately, so that Taylor series get through a time in contact.
inline void soften_for_slides(support::Random& random, double& stiffness, double& damping) {
  stiffness = random.logarithmic(2, 1e3);
  damping = random.happens(0.3) ? 0 : random.happens(0.2) ? random.logarithmic(1, 3) : random.uniform(0, 1);
}

/// A spring other than that of k = 1: none, or an unstable one between two stops.
inline double any_other_stiffness(support::Random& random, const Stops& stops, double duration) {
  const bool bounded = std::isfinite(stops.lower) && std::isfinite(stops.upper);
  if (!bounded || random.happens(0.4)) return 0;
  return -std::min(random.logarithmic(1e-3, 1), 80 / (duration * duration));
}

/// No stops, or some of them soft: an eighth of the scenes, and two fifths.
inline void vary_stops(support::Random& random, Stops& stops) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (random.happens(0.125)) stops = {-none, none, 1, 1};
  if (random.happens(0.6)) return;
  const double kind = random.uniform(0, 1);
  if (kind < 0.7 && std::isfinite(stops.lower)) soften_for_slides(random, stops.stiffness_lower, stops.damping_lower);
  if (kind > 0.3 && std::isfinite(stops.upper)) soften_for_slides(random, stops.stiffness_upper, stops.damping_upper);
}

/// More starts at rest, and some beyond the position of a soft stop.
inline void vary_start(support::Random& random, const Stops& stops, Start& start) {
  if (random.happens(0.2)) start.velocity = 0;
  const Side side = random.happens(0.5) ? Side::lower : Side::upper;
  if (!is_soft(stops, side) || !random.happens(0.1)) return;
  const double kappa = side == Side::upper ? stops.stiffness_upper : stops.stiffness_lower;
  const double position = side == Side::upper ? stops.upper : stops.lower;
  start.displacement = position + sign_of(side) * random.logarithmic(1e-6, 1) / std::sqrt(kappa);
}

/// A random scene with dry friction; forces, damping and stops otherwise as `any_scene` draws them. Without a spring
/// there is a load: without both a mass that leaves a stop comes back to it without any speed, so rounding decides
/// whether it meets it.
[[nodiscard]] inline AnyScene any_sliding_scene(std::uint64_t index) {
  AnyScene any = any_scene(index);
  support::Random random(20470, index);
  auto& [oscillator, stops, start, shaking, friction, loose] = static_cast<Scene&>(any.scene);
  vary_stops(random, stops);
  if (!std::isfinite(stops.lower) && !std::isfinite(stops.upper)) start = any_start(random, {-1, 1, 1, 1});
  oscillator.stiffness = random.happens(0.75) ? 1 : any_other_stiffness(random, stops, any.duration);
  vary_start(random, stops, start);
  const double force = oscillator.forcing != 0 ? std::abs(oscillator.forcing) : 1;
  if (oscillator.stiffness == 0 && oscillator.load == 0)
    oscillator.load = random.sign() * force * random.logarithmic(1e-3, 1);
  friction.kinetic = force * any_kinetic(random);
  friction.static_level = force * any_static_level(random, friction.kinetic / force);
  if (friction.static_level < friction.kinetic) friction.static_level = friction.kinetic;
  return any;
}

inline constexpr Kind sliding{"sliding", any_sliding_scene, 1000};

}  // namespace clatter::hard
