#include "branches/walk/corner.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::branches {
namespace {

/// The law of an impact without its threshold, at which a branch ends.
Restitution<double> law_without_threshold(const FollowedScene& scene, const OrbitEvent& impact) {
  Restitution<double> law = law_at(numbers_of<double>(scene), impact.kind, impact.side);
  law.below = 0;
  return law;
}

/// The speed of the first corner of a law from one speed to another; nothing if there is none.
std::optional<double> first_corner(const Restitution<double>& law, double from, double to) {
  const auto is_smooth_up_to = [&](double speed) {
    return law.bend(std::min(from, speed), std::max(from, speed)).has_value();
  };
  if (!(from > 0 && to > 0) || is_smooth_up_to(to)) return std::nullopt;
  double smooth = from, beyond = to;
  for (int i = 0; i < 100; ++i) {
    const double middle = smooth + (beyond - smooth) / 2;
    (is_smooth_up_to(middle) ? smooth : beyond) = middle;
  }
  return beyond;
}

}  // namespace

std::optional<Corner> corner_between(const OrbitEquations& equations, const Vector& here, const Vector& there) {
  const FollowedScene scene = equations.scene_at(here);
  const Orbit from = equations.orbit_at(here), to = equations.orbit_at(there);
  std::optional<Corner> first;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!is_impact(from.events[i].kind)) continue;
    const double v = std::abs(from.events[i].before), there_v = std::abs(to.events[i].before);
    const auto speed = first_corner(law_without_threshold(scene, from.events[i]), v, there_v);
    if (!speed) continue;
    const double share = (*speed - v) / (there_v - v);
    if (!first || share < first->share) first = {i, share, *speed, there_v > v ? 1 : -1};
  }
  return first;
}

std::optional<CurvePoint> beyond_corner(const OrbitEquations& equations, const CurvePoint& here, const Vector& there,
                                        const Corner& corner, double tolerance) {
  constexpr double a_little = 1e-7;  // of the speed
  const std::size_t velocity = equations.phase_of(corner.event) + 1;
  const double now = std::abs(equations.orbit_at(here.at).events[corner.event].before);
  const Vector way = sum(there, -1.0, here.at);
  Vector guess = sum(here.at, corner.share, way), direction(guess.size(), 0.0);
  guess[velocity] = here.at[velocity] * (corner.speed / now) * (1 + corner.heading * a_little);
  direction[velocity] = std::copysign(1.0, corner.heading * here.at[velocity]);
  const auto at = corrected(equations, guess, direction, tolerance);
  if (!at || !(largest(sum(*at, -1.0, guess)) <= largest(way))) return std::nullopt;
  const auto along = tangent(equations, *at, direction);
  if (!along) return std::nullopt;
  const Vector passed = sum(*at, -1.0, here.at);
  return CurvePoint{*at, *along, here.arclength + std::sqrt(product(passed, passed))};
}

}  // namespace clatter::branches
