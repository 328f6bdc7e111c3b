#pragma once

#include <algorithm>
#include <cmath>

#include "hard/any_scene.hpp"
#include "hard/tally.hpp"

namespace clatter::hard {

inline double any_stop_damping(support::Random& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.2) return 0;
  if (kind < 0.8) return kind < 0.4 ? random.logarithmic(1e-3, 1) : random.uniform(0, 1);
  return random.logarithmic(1, 30);
}

/// Soft stops in place of rigid ones: both, or one of two. They outdo an unstable spring at least twice.
inline void soften(support::Random& random, const Oscillator& oscillator, Stops& stops) {
  const auto any_kappa = [&] { return std::max(random.logarithmic(1e-1, 1e8), -2 * oscillator.stiffness); };
  const bool bounded = std::isfinite(stops.lower) && std::isfinite(stops.upper);
  const double kind = bounded ? random.uniform(0, 1) : 1;
  if (kind > 0.15) stops.stiffness_lower = any_kappa(), stops.damping_lower = any_stop_damping(random);
  if (kind < 0.15 || kind > 0.3) stops.stiffness_upper = any_kappa(), stops.damping_upper = any_stop_damping(random);
  if (!std::isfinite(stops.lower)) stops.stiffness_lower = std::numeric_limits<double>::infinity();
  if (!std::isfinite(stops.upper)) stops.stiffness_upper = std::numeric_limits<double>::infinity();
}

/// A random scene with soft stops: that of `any_scene` otherwise. A tenth starts beyond the position of a stop.
[[nodiscard]] inline AnyScene any_soft_scene(std::uint64_t index) {
  AnyScene any = any_scene(index);
  support::Random random(20250, index);
  auto& [oscillator, stops, start, shaking, friction, loose] = static_cast<Scene&>(any.scene);
  soften(random, oscillator, stops);
  if (!random.happens(0.1)) return any;
  const Side side = is_soft(stops, Side::upper) ? Side::upper : Side::lower;
  const double kappa = side == Side::upper ? stops.stiffness_upper : stops.stiffness_lower;
  const double depth = random.logarithmic(1e-9, 1) / std::sqrt(1 + kappa);
  start.displacement = side == Side::upper ? stops.upper + depth : stops.lower - depth;
  return any;
}

inline constexpr Kind between_soft_stops{"soft", any_soft_scene, 4000};

}  // namespace clatter::hard
