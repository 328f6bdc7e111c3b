#include "branches/walk/rebound_threshold.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::branches {
namespace {

/// By how much an impact is faster than one without a rebound, over the speed of that; nothing of other events.
std::optional<double> margin_of(const FollowedScene& scene, const OrbitEvent& event) {
  if (!is_impact(event.kind)) return std::nullopt;
  const bool upper = event.side == Side::upper;
  const LooseMass& loose = scene.loose;
  const Restitution<double>& law = !event.is_of_wall() ? law_of(scene.stops, event.side)
                                   : upper             ? loose.restitution_upper
                                                       : loose.restitution_lower;
  return law.below > 0 ? std::optional(std::abs(event.before) / law.below - 1) : std::nullopt;
}

}  // namespace

std::optional<std::size_t> impact_without_rebound(const FollowedScene& scene, const Orbit& orbit) {
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (const auto margin = margin_of(scene, orbit.events[i]); margin && *margin < 0) return i;
  return std::nullopt;
}

bool is_at_threshold(const FollowedScene& scene, const Orbit& orbit, double within) {
  return std::ranges::any_of(orbit.events, [&](const OrbitEvent& event) {
    const auto margin = margin_of(scene, event);
    return margin && std::abs(*margin) < within;
  });
}

CurvePoint point_at_threshold(const OrbitEquations& equations, const Walk& walk, const Narrowed& between) {
  const std::size_t event = between.violated.event;
  const auto margin = [&](const CurvePoint& point) {
    return margin_of(equations.scene_at(point.at), equations.orbit_at(point.at).events[event]).value_or(0.0);
  };
  const double begin = walk.here().arclength;
  return walk.zero(margin, between.beyond.arclength - begin, between.last_good.arclength - begin)
      .value_or(between.last_good);
}

}  // namespace clatter::branches
