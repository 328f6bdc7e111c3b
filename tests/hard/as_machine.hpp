#pragma once

#include <algorithm>
#include <cmath>

#include "hard/any_scene.hpp"
#include "hard/machine.hpp"
#include "scene/scene.hpp"

namespace clatter::hard {

/// A law of restitution in the simulator's terms.
[[nodiscard]] inline Law law_of_speed(const Restitution<double>& of) {
  Law law{.exponent = of.exponent, .reference = of.reference, .below = of.below, .unit = of.unit};
  if (of.table)
    for (const auto& [speed, R] : of.table->knots) law.knots.push_back({speed, R});
  return law;
}

/// The rows of a measured force in the simulator's terms.
[[nodiscard]] inline std::vector<ForceRow> rows_of(const ForceTable* table) {
  std::vector<ForceRow> rows;
  if (table)
    for (const auto& [turns, before, after] : table->knots())
      rows.push_back({turns, before / table->peak(), after / table->peak()});
  return rows;
}

/// The orders of a force in the simulator's terms.
[[nodiscard]] inline std::vector<ForceWave> waves_of(const ForceOrders<double>& orders) {
  std::vector<ForceWave> waves;
  for (std::size_t j = 1; j <= orders.of.size(); ++j)
    if (!orders.is_zero(j))
      waves.push_back({static_cast<int>(j), orders.of[j - 1].in_phase, orders.of[j - 1].quadrature});
  return waves;
}

/// A scene in the simulator's terms.
[[nodiscard]] inline MachineScene as_machine(const Scene& scene) {
  const auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  return {.damping = oscillator.damping,
          .stiffness = oscillator.stiffness,
          .forcing = oscillator.forcing,
          .frequency = oscillator.frequency,
          .phase = start.phase,
          .load = oscillator.load,
          .shape = static_cast<ForceShape>(oscillator.shape.waveform),
          .duty = oscillator.shape.duty,
          .rise = oscillator.shape.rise,
          .table = rows_of(oscillator.shape.table),
          .waves = waves_of(oscillator.shape.orders),
          .friction = friction.kinetic,
          .static_friction = friction.static_level,
          .lower = stops.lower,
          .upper = stops.upper,
          .restitution_lower = stops.restitution_lower.R,
          .restitution_upper = stops.restitution_upper.R,
          .law_lower = law_of_speed(stops.restitution_lower),
          .law_upper = law_of_speed(stops.restitution_upper),
          .kappa_lower = stops.stiffness_lower,
          .kappa_upper = stops.stiffness_upper,
          .zeta_lower = stops.damping_lower,
          .zeta_upper = stops.damping_upper,
          .shake_lower = stops.motion_lower.amplitude,
          .shake_upper = stops.motion_upper.amplitude,
          .shake_phase_lower = stops.motion_lower.phase,
          .shake_phase_upper = stops.motion_upper.phase,
          .loose_mass = loose.ratio,
          .wall_lower = loose.lower,
          .wall_upper = loose.upper,
          .wall_R_lower = loose.restitution_lower.R,
          .wall_R_upper = loose.restitution_upper.R,
          .wall_law_lower = law_of_speed(loose.restitution_lower),
          .wall_law_upper = law_of_speed(loose.restitution_upper),
          .wall_kappa_lower = loose.stiffness_lower,
          .wall_kappa_upper = loose.stiffness_upper,
          .wall_zeta_lower = loose.damping_lower,
          .wall_zeta_upper = loose.damping_upper,
          .loose_load = loose.load,
          .loose_friction = loose.friction,
          .loose_static = loose.friction_static,
          .x = start.displacement,
          .v = start.velocity,
          .z = loose.place,
          .w = loose.velocity};
}

/// A stop at the start.
struct StopAtStart {
  double place, velocity;
  bool is_met = false, is_followed = false;  ///< the mass is on it, and has its velocity, to the simulator's rounding
};
[[nodiscard]] inline StopAtStart stop_at_start(const MachineScene& s, int side) {
  const double place = side > 0 ? s.upper : s.lower, amplitude = side > 0 ? s.shake_upper : s.shake_lower;
  if (amplitude == 0) return {place, 0, s.x == place};
  const double angle = s.phase + (side > 0 ? s.shake_phase_upper : s.shake_phase_lower);
  StopAtStart stop{place + amplitude * std::sin(angle), s.frequency * amplitude * std::cos(angle)};
  const double size = std::abs(s.x) + std::abs(place) + std::abs(amplitude);
  const double fastest = std::abs(s.v) + std::abs(s.frequency * amplitude);
  stop.is_met = std::abs(s.x - stop.place) <= 16 * epsilon<double>() * size;
  stop.is_followed = stop.is_met && std::abs(s.v - stop.velocity) <= 16 * epsilon<double>() * fastest;
  return stop;
}
/// Keeps the main mass on a moving stop that it starts on, and between rigid ones if it starts there.
inline void keep_at_moving_stops(MachineScene& s, const MachineScene& given) {
  for (const int side : {-1, 1}) {
    if ((side > 0 ? given.shake_upper : given.shake_lower) == 0) continue;
    const StopAtStart before = stop_at_start(given, side), stop = stop_at_start(s, side);
    const bool is_rigid = !std::isfinite(side > 0 ? given.kappa_upper : given.kappa_lower);
    const bool was_between = side * (before.place - given.x) >= 0, is_beyond = side * (s.x - stop.place) > 0;
    if (before.is_met || (is_rigid && was_between && is_beyond)) s.x = stop.place;
    if (before.is_followed) s.v = stop.velocity;
  }
}

/// The same with each input moved by some roundings, z by those of y, and a mass with the stop or wall that it starts
/// on, with the velocity of a moving stop if it has that. Signs are drawn, but friction rises against the force or
/// falls.
[[nodiscard]] inline MachineScene moved(const AnyScene& any, std::uint64_t way, double roundings,
                                        double roundings_of_phase) {
  support::Random random(20611, 8 * any.index + way);
  const MachineScene given = as_machine(any.scene);
  MachineScene s = given;
  const auto nudge = [&](double& value) { value *= 1 + random.sign() * roundings * epsilon<double>(); };
  for (double* value : {&s.damping,
                        &s.stiffness,
                        &s.forcing,
                        &s.frequency,
                        &s.load,
                        &s.lower,
                        &s.upper,
                        &s.kappa_lower,
                        &s.kappa_upper,
                        &s.zeta_lower,
                        &s.zeta_upper,
                        &s.wall_kappa_lower,
                        &s.wall_kappa_upper,
                        &s.wall_zeta_lower,
                        &s.wall_zeta_upper,
                        &s.loose_mass,
                        &s.wall_lower,
                        &s.wall_upper,
                        &s.loose_load,
                        &s.x,
                        &s.v,
                        &s.z,
                        &s.w})
    nudge(*value);
  for (double* R : {&s.restitution_lower, &s.restitution_upper, &s.wall_R_lower, &s.wall_R_upper})
    nudge(*R), *R = std::min(1.0, *R);
  s.phase += random.sign() * roundings_of_phase * epsilon<double>();
  const double rise = (way % 2 == 0 ? 1 : -1) * roundings * epsilon<double>();
  if (given.static_friction > 0) s.forcing = given.forcing * (1 - rise);
  s.friction *= 1 + rise, s.static_friction *= 1 + rise;
  s.loose_friction *= 1 + rise, s.loose_static *= 1 + rise;
  s.z = std::clamp(s.z + random.sign() * roundings / 2 * epsilon<double>() * given.x, s.wall_lower, s.wall_upper);
  if (given.z == given.wall_lower) s.z = s.wall_lower;
  if (given.z == given.wall_upper) s.z = s.wall_upper;
  if (given.x == given.lower) s.x = s.lower;
  if (given.x == given.upper) s.x = s.upper;
  for (Law* law : {&s.law_lower, &s.law_upper, &s.wall_law_lower, &s.wall_law_upper}) {
    for (double* value : {&law->exponent, &law->reference, &law->below, &law->unit}) nudge(*value);
    for (Law::Knot& knot : law->knots) nudge(knot.R), knot.R = std::min(1.0, knot.R);
  }
  if (given.shape != ForceShape::sine) {
    nudge(s.duty), nudge(s.rise);
    s.duty = std::min(1.0, s.duty), s.rise = std::min(0.5, s.rise);
    for (ForceWave& wave : s.waves) nudge(wave.sine), nudge(wave.cosine);
  }
  nudge(s.shake_lower), nudge(s.shake_upper);
  for (double* phase : {&s.shake_phase_lower, &s.shake_phase_upper})
    *phase += random.sign() * roundings * epsilon<double>();
  keep_at_moving_stops(s, given);
  return s;
}

}  // namespace clatter::hard
