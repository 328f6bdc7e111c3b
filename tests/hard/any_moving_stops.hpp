#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>

#include "hard/any_scene.hpp"
#include "hard/any_soft_scene.hpp"

namespace clatter::hard {

/// Two stops at least 0.06 apart, or one.
inline Stops any_stops_apart(support::Random& random) {
  Stops stops = any_stops(random);
  if (stops.upper - stops.lower < 0.06) stops.upper = stops.lower + random.logarithmic(0.06, 3);
  return stops;
}

/// The largest by which both stops come nearer to each other.
[[nodiscard]] inline double approach_of(const Stops& stops) {
  return std::abs(std::polar(1.0, stops.motion_upper.phase) * stops.motion_upper.amplitude -
                  std::polar(1.0, stops.motion_lower.phase) * stops.motion_lower.amplitude);
}

/// Moves one stop, or both: each for itself, as one, or against each other. They stay more than 0.02 apart.
inline void let_move(support::Random& random, Stops& stops) {
  const bool has_lower = std::isfinite(stops.lower), has_upper = std::isfinite(stops.upper);
  const auto any_motion = [&]() -> StopMotion {
    return {random.sign() * random.logarithmic(1e-3, 1), random.happens(0.2) ? 0 : random.uniform(-3, 3)};
  };
  StopMotion &lower = stops.motion_lower, &upper = stops.motion_upper;
  const double kind = random.uniform(0, 1);
  const bool both = has_lower && has_upper;
  if (!both || kind < 0.6) {
    if (has_lower && (!both || kind < 0.2 || kind > 0.4)) lower = any_motion();
    if (has_upper && (!both || kind > 0.2)) upper = any_motion();
  } else {
    lower = upper = any_motion();
    if (kind > 0.85) upper.amplitude *= -1;
  }
  if (!both) return;
  const double room = stops.upper - stops.lower - 0.021, most = approach_of(stops);
  if (!(most > room)) return;
  const double share = room / most * random.uniform(0.1, 1);
  lower.amplitude *= share, upper.amplitude *= share;
}

/// Where a stop is at the start, and its velocity.
struct PlaceAndVelocity {
  double place, velocity;
};
[[nodiscard]] inline PlaceAndVelocity at_start(const Scene& scene, Side side) {
  const auto& [amplitude, phase] = motion_of(scene.stops, side);
  const double angle = scene.start.phase + phase;
  return {(side == Side::upper ? scene.stops.upper : scene.stops.lower) + amplitude * std::sin(angle),
          scene.oscillator.frequency * amplitude * std::cos(angle)};
}

/// A start between the moving stops. A fifth is on one of them, at rest on it, moving off or against it.
inline void draw_start(support::Random& random, Scene& scene) {
  const Stops& stops = scene.stops;
  scene.start.phase = random.happens(0.1) ? 0 : random.uniform(0, 2 * std::numbers::pi);
  const bool has_lower = std::isfinite(stops.lower), has_upper = std::isfinite(stops.upper);
  const PlaceAndVelocity lower = at_start(scene, Side::lower), upper = at_start(scene, Side::upper);
  const double low = has_lower ? lower.place : upper.place - 3, high = has_upper ? upper.place : lower.place + 3;
  const double v = random.sign() * random.logarithmic(1e-2, 3);
  scene.start.displacement = low + (high - low) * random.uniform(0.001, 0.999);
  scene.start.velocity = random.happens(0.1) ? 0 : v;
  if (!random.happens(0.2)) return;
  const bool on_upper = has_upper && (!has_lower || random.happens(0.5));
  const PlaceAndVelocity stop = on_upper ? upper : lower;
  scene.start.displacement = stop.place;
  scene.start.velocity = stop.velocity + (random.happens(0.4) ? 0 : v);
}

/// A ball that jumps on a shaken table, in some scenes below a ceiling: the table throws it now and then, or often.
inline void make_ball(support::Random& random, Scene& scene) {
  auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  const double nu = random.logarithmic(0.3, 10), weight = random.logarithmic(0.1, 2);
  oscillator = {0, 0, nu, -weight, 0};
  stops = {random.happens(0.5) ? 0 : random.uniform(-1, 1), std::numeric_limits<double>::infinity(),
           any_restitution(random), any_restitution(random)};
  const double amplitude = std::min(1.0, weight / (nu * nu) * random.logarithmic(0.3, 10));
  stops.motion_lower = {amplitude, random.happens(0.5) ? 0 : random.uniform(-3, 3)};
  if (random.happens(0.4)) stops.upper = stops.lower + amplitude + random.logarithmic(0.05, 1);
}

/// By how many radians anything turns or falls in a run at most, but for the force and the stops: Taylor series take as
/// many steps.
inline constexpr double most_turns = 5e3;

/// Soft stops of which the contacts aren't much faster than the run.
inline void soften_slowly(support::Random& random, Scene& scene, double duration) {
  Stops& stops = scene.stops;
  soften(random, scene.oscillator, stops);
  const auto slow_down = [&](double& kappa, double zeta) {
    if (!std::isfinite(kappa)) return;
    const double fastest = most_turns / (duration * (1 + 2 * zeta));
    kappa = std::max(std::min(kappa, fastest * fastest), -2 * scene.oscillator.stiffness);
  };
  slow_down(stops.stiffness_lower, stops.damping_lower), slow_down(stops.stiffness_upper, stops.damping_upper);
}

/// A random scene of which stops move by themselves, rigid ones or soft ones.
[[nodiscard]] inline AnyScene any_moving_stops(std::uint64_t index) {
  support::Random random(20741, index);
  point::Problem scene;
  Oscillator& o = scene.oscillator;
  const bool is_ball = random.happens(0.15);
  if (is_ball) {
    make_ball(random, scene);
  } else {
    o = any_oscillator(random);
    if (random.happens(0.15)) o.forcing = 0;
    if (random.happens(0.1)) o.frequency = random.happens(0.5) ? random.logarithmic(0.02, 0.1) : random.uniform(10, 30);
    scene.stops = any_stops_apart(random);
    let_move(random, scene.stops);
  }
  o.paces_stops = true;
  draw_start(random, scene);
  scene.time.mode = steady::Mode::transient;
  scene.time.max_impacts = 2e3;
  const double most = most_turns / (1 + 2 * o.damping);
  scene.time.duration = std::min(random.uniform(2, 6) * 2 * std::numbers::pi / o.frequency, most);
  if (!is_ball && random.happens(0.2)) {
    const bool both = std::isfinite(scene.stops.lower) && std::isfinite(scene.stops.upper);
    if (both) o.stiffness = any_stiffness(random, scene.stops, scene.time.duration);
  }
  if (random.happens(is_ball ? 0.15 : 0.4)) soften_slowly(random, scene, scene.time.duration);
  return {index, scene, scene.time.duration};
}

}  // namespace clatter::hard
