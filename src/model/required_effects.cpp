#include "model/required_effects.hpp"

#include <cmath>
#include <limits>

#include "model/displacement_bound.hpp"

namespace clatter {
inline namespace model {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

enum class Sharpness { sufficient, sharpest };

/// Both kinds of bounds give the same effects; sufficient ones cost less.
Requirements requirements(const Scene& scene, double duration, Sharpness bounds) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  Requirements needs{
      {.damping = damping_of(o), .forcing = forcing_of(o), .load = o.load != 0, .stiffness = o.stiffness != 1.0}};
  const double middle = equilibrium_of(o);
  needs.lower_gap = middle - stops.lower, needs.upper_gap = stops.upper - middle;
  const PhaseState start{scene.start.displacement - middle, scene.start.velocity, std::sin(scene.start.phase),
                         std::cos(scene.start.phase)};
  const double enough = bounds == Sharpness::sharpest ? 0.0 : std::fmin(needs.lower_gap, needs.upper_gap);
  needs.free_reach = displacement_bound(o, start, duration, enough);
  needs.reach = displacement_bound_through_impacts(o, start, duration);
  Effects& effects = needs.effects;
  if (!(needs.free_reach < needs.lower_gap && needs.free_reach < needs.upper_gap)) {  // else none is ever met
    effects.lower = std::isfinite(stops.lower) && !(needs.reach < needs.lower_gap);
    effects.upper = std::isfinite(stops.upper) && !(needs.reach < needs.upper_gap);
  }
  effects.dissipation =
      (effects.lower && !(stops.restitution_lower >= 1)) || (effects.upper && !(stops.restitution_upper >= 1));
  const double push = std::abs(o.forcing) * (1 + 4 * std::numeric_limits<double>::epsilon());
  effects.rest = (effects.lower && !(push < constant_force(o, stops.lower))) ||
                 (effects.upper && !(push < -constant_force(o, stops.upper)));
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

}  // namespace model
}  // namespace clatter
