#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "motion/state.hpp"
#include "motion/walls.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/scene.hpp"

namespace clatter::attractors {

/// A state at a section: that of the mass and, if it carries a loose one, the place z of that in its housing and z'.
struct SectionState : PhasePoint {
  constexpr SectionState() : PhasePoint{0.0, 0.0} {}
  constexpr SectionState(const PhasePoint& main) : PhasePoint(main) {}
  constexpr SectionState(double x_at, double v_at, double z_at = 0.0, double w_at = 0.0)
      : PhasePoint{x_at, v_at}, z(z_at), w(w_at) {}

  double z = 0.0, w = 0.0;  ///< 0 without a loose mass
};

[[nodiscard]] inline SectionState section_of(const Scene& scene, const motion::State<double>& state) {
  if (!has_loose_mass(scene.loose)) return {state.x, state.v};
  const auto [z, w] = motion::place_in_housing(state, scene.loose);
  return {state.x, state.v, z, w};
}

/// The largest of its numbers.
[[nodiscard]] inline double size_of(const SectionState& state) {
  return std::max(std::max(std::abs(state.x), std::abs(state.v)), std::max(std::abs(state.z), std::abs(state.w)));
}

[[nodiscard]] inline SectionState difference(const SectionState& from, const SectionState& to) {
  return {to.x - from.x, to.v - from.v, to.z - from.z, to.w - from.w};
}

/// A loose mass that no wall meets may be at any place of its housing.
inline void forget_places(std::span<SectionState> states) {
  for (SectionState& state : states) state.z = 0;
}

/// The rigid stops at the phase of the start of a scene; soft ones may be passed.
[[nodiscard]] inline StopsNow stops_at_start(const Scene& scene) {
  return {rigid_ones(scene.stops), scene.oscillator.frequency, scene.start.phase};
}

/// A state, at that phase, at which no stop is passed, and no wall of a loose mass.
[[nodiscard]] inline bool is_inside(const Scene& scene, const SectionState& state) {
  const Stops stops = stops_at_start(scene);
  return state.x >= stops.lower && state.x <= stops.upper && std::isfinite(state.x) && std::isfinite(state.v) &&
         state.z >= scene.loose.lower && state.z <= scene.loose.upper && std::isfinite(state.z) &&
         std::isfinite(state.w);
}

/// The nearest such state.
[[nodiscard]] inline SectionState moved_inside(const Scene& scene, const SectionState& state) {
  const Stops stops = stops_at_start(scene);
  return {std::clamp(state.x, stops.lower, stops.upper), state.v,
          std::clamp(state.z, scene.loose.lower, scene.loose.upper), state.w};
}

/// Whether friction of the main mass holds it for good: away from rigid stops, with a loose mass that rests in the
/// housing, too.
[[nodiscard]] inline bool stands_for_good(Scene scene, const SectionState& state) {
  const LooseMass& loose = scene.loose;
  const double pull = loose.ratio * loose.load;
  const bool is_on_wall = (state.z == loose.upper && pull > 0) || (state.z == loose.lower && pull < 0);
  if (state.v != 0 || state.w != 0 || !(is_on_wall || std::abs(pull) <= loose.friction_static)) return false;
  scene.oscillator.load += pull;
  return sticks_for_good(scene, state.x);
}

/// Whether a loose mass can stay for ever where no wall meets it: in some places of its housing the steady motion of
/// the main mass alone passes between the walls, and no force moves it from there. Beside stops, and with friction in
/// the housing, the room that motion takes isn't looked at.
[[nodiscard]] inline bool may_float(const Scene& scene) {
  if (has_loose_friction(scene.loose)) return true;
  if (!has_loose_mass(scene.loose) || scene.loose.load != 0) return false;
  if (has_events_of_its_own(scene)) return true;
  if (!scene.oscillator.shape.is_sine()) return false;  // how far that reaches isn't known
  const PhasePoint response = response_at(scene.oscillator, 0.0, 1.0);
  const double reach = std::hypot(response.x, response.v / scene.oscillator.frequency);
  return 2 * reach < scene.loose.upper - scene.loose.lower;
}

}  // namespace clatter::attractors
