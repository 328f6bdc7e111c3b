#include "scene/required_effects.hpp"

#include <cmath>
#include <limits>

#include "scene/displacement_bound.hpp"

namespace clatter {
inline namespace scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bound of the distance from the equilibrium under friction, while no stop interferes: what moves the mass without it,
/// and what friction adds (eq. 62), or the energy, which friction never raises (eq. 18). A mass that friction holds
/// stays where it is.
double rubbing_reach(const Scene& scene, const PhaseState& start, double duration) {
  if (never_moves(scene)) return std::abs(start.x) * (1 + 64 * std::numeric_limits<double>::epsilon());
  const Oscillator& o = scene.oscillator;
  return std::fmin(displacement_bound(o, start, duration, 0.0) + friction_bound(o, scene.friction),
                   displacement_bound_through_impacts(o, start, duration));
}

enum class Sharpness { sufficient, sharpest };

/// Both kinds of bounds give the same effects; sufficient ones cost less.
Requirements requirements(const Scene& scene, double duration, Sharpness bounds) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  Requirements needs{
      {.damping = damping_of(o), .forcing = forcing_of(o), .load = o.load != 0, .stiffness = is_general(o)}};
  needs.effects.friction = has_friction(scene.friction), needs.effects.loose = has_loose_mass(scene.loose);
  const double middle = equilibrium_of(o);
  needs.lower_gap = middle - stops.lower, needs.upper_gap = stops.upper - middle;
  const PhaseState start{scene.start.displacement - middle, scene.start.velocity, std::sin(scene.start.phase),
                         std::cos(scene.start.phase)};
  const double enough = bounds == Sharpness::sharpest ? 0.0 : std::fmin(needs.lower_gap, needs.upper_gap);
  needs.free_reach =
      needs.effects.friction ? rubbing_reach(scene, start, duration) : displacement_bound(o, start, duration, enough);
  const bool soft_lower = is_soft(stops, Side::lower), soft_upper = is_soft(stops, Side::upper);
  const double x0 = scene.start.displacement;
  const bool in_a_stop = (soft_lower && x0 < stops.lower) || (soft_upper && x0 > stops.upper);
  // a loose mass gives the main one energy, of which no bound is known
  const bool moves_into = move_by_themselves(stops);  // so do stops that move
  const bool meets_none =
      !needs.effects.loose && !moves_into && needs.free_reach < needs.lower_gap && needs.free_reach < needs.upper_gap;
  if (!meets_none || bounds == Sharpness::sharpest)
    needs.reach = in_a_stop || needs.effects.loose || moves_into
                      ? infinity
                      : displacement_bound_through_impacts(o, start, duration);  // it stores energy
  Effects& effects = needs.effects;
  if (!meets_none) {
    effects.lower = std::isfinite(stops.lower) && !(needs.reach < needs.lower_gap);
    effects.upper = std::isfinite(stops.upper) && !(needs.reach < needs.upper_gap);
  }
  effects.own_motion = move_by_themselves(stops);
  effects.soft = (effects.lower && soft_lower) || (effects.upper && soft_upper);
  effects.dissipation =
      (effects.lower && takes_energy(stops, Side::lower)) || (effects.upper && takes_energy(stops, Side::upper));
  // friction holds a mass that is pulled away from a stop, too
  const double push =
      (std::abs(o.forcing) + scene.friction.static_level) * (1 + 4 * std::numeric_limits<double>::epsilon());
  // and so is the pull of a loose mass that a wall presses, or that rubs
  const double pull = has_soft_wall(scene.loose)  // which may press it with any force
                          ? infinity
                          : push + std::abs(scene.loose.ratio * scene.loose.load) + scene.loose.friction_static;
  const double accelerates = moves_into ? infinity : pull;
  effects.rest = (effects.lower && !soft_lower && !(accelerates < constant_force(o, stops.lower))) ||
                 (effects.upper && !soft_upper && !(accelerates < -constant_force(o, stops.upper)));
  return needs;
}

}  // namespace

Requirements requirements_of(const Scene& scene, double duration) {
  return requirements(scene, duration, Sharpness::sharpest);
}

Effects required_effects(const Scene& scene, double duration) {
  return requirements(scene, duration, Sharpness::sufficient).effects;
}

Stops stops_in_reach(const Stops& stops, const Effects& effects) {
  Stops met = stops;
  if (!effects.lower) met.lower = -infinity;
  if (!effects.upper) met.upper = infinity;
  return met;
}

}  // namespace scene
}  // namespace clatter
