#include "branches/walk/ceasing.hpp"

#include <cmath>
#include <numbers>

namespace clatter::branches {
namespace {

/// The mass at rest where the spring is, if there is one.
Orbit at_rest(const FollowedScene& scene, Orbit orbit) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const Orbit slipping = orbit;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    OrbitEvent& stick = orbit.events[i];
    stick.phase = crest_near(p, slipping.heading_before(i), stick.phase);
    const Side stop = stick.held_by();
    const double k = p.oscillator.stiffness + (stop == Side::none ? 0.0 : p.soft_stop(stop).stiffness);
    if (k != 0) stick.place = stop == Side::none ? 0.0 : p.standing_force(p.middle(), stop) / k;
  }
  return orbit;
}

}  // namespace

double crest_near(const SceneNumbers<double>& p, Side side, double phase) {
  constexpr double turn = 2 * std::numbers::pi;
  const LeadingForce<double> force = p.force();
  const double crest = (sign_of(side) * force.amplitude > 0 ? turn : -turn) / 4 - force.lead;
  return crest + turn * std::round((phase - crest) / turn);
}

std::optional<ExactGraze> where_motion_ceases(const OrbitEquations& equations, FollowedScene near, const Orbit& orbit,
                                              double within) {
  constexpr int most_iterations = 20;
  const auto& [parameter, unit] = equations.axes().front();
  const double guess = value_of(near, parameter);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const SceneNumbers<Along> p = numbers_along(near, parameter);
    const Along left = p.friction.static_level - abs(p.force().amplitude);
    const double step = -left.value / left.slope[0], value = value_of(near, parameter);
    if (!std::isfinite(step)) return std::nullopt;
    near = changed(near, parameter, value + step);
    if (!(std::abs(step) <= 1e-12 * unit)) continue;
    if (!(std::abs(value + step - guess) <= within * unit)) return std::nullopt;
    return ExactGraze{near, at_rest(near, orbit)};
  }
  return std::nullopt;
}

}  // namespace clatter::branches
