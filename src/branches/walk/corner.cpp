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

/// A law at both ends of a way, with the speed of an impact.
struct Ends {
  Restitution<double> here_law, there_law;
  double here, there;
};

/// The corner that the speed passes upwards or downwards, though the corner may move meanwhile.
std::optional<Corner> passed(const Ends& ends, int heading) {
  constexpr double near = 2;  // times the speed: a step that changes it more is too long anyway
  const double far = heading > 0 ? near : 1 / near;
  const auto corner = first_corner(ends.here_law, ends.here, ends.here * far);
  if (!corner) return std::nullopt;
  const auto moved = first_corner(ends.there_law, *corner / std::sqrt(far), *corner * std::sqrt(far));
  if (!moved) return std::nullopt;
  const double before = heading * (*corner - ends.here), after = heading * (*moved - ends.there);
  if (!(before >= 0 && after < 0)) return std::nullopt;
  return Corner{0, before / (before - after), heading, *corner, *moved};
}

}  // namespace

std::optional<Corner> corner_between(const OrbitEquations& equations, const Vector& here, const Vector& there) {
  const FollowedScene here_scene = equations.scene_at(here), there_scene = equations.scene_at(there);
  const Orbit from = equations.orbit_at(here), to = equations.orbit_at(there);
  std::optional<Corner> first;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const OrbitEvent &one = from.events[i], &other = to.events[i];
    if (!is_impact(one.kind)) continue;
    const Ends ends{law_without_threshold(here_scene, one), law_without_threshold(there_scene, other),
                    std::abs(one.before), std::abs(other.before)};
    if (ends.here_law.is_constant()) continue;
    for (const int heading : {1, -1})
      if (auto corner = passed(ends, heading); corner && (!first || corner->share < first->share))
        first = corner, first->event = i;
  }
  return first;
}

std::optional<CurvePoint> beyond_corner(const OrbitEquations& equations, const CurvePoint& here, const Vector& there,
                                        const Corner& corner, double tolerance) {
  constexpr double a_little = 1e-7;  // of the speed
  const std::size_t velocity = equations.phase_of(corner.event) + 1, parameter = equations.unknowns() - 1;
  const double unit = here.at[velocity] / equations.orbit_at(here.at).events[corner.event].before,
               sign = std::copysign(1.0, here.at[velocity]);
  const double speed = corner.here + corner.share * (corner.there - corner.here);
  const Vector way = sum(there, -1.0, here.at);
  Vector guess = sum(here.at, corner.share, way), direction(guess.size(), 0.0);
  guess[velocity] = sign * std::abs(unit) * speed * (1 + corner.heading * a_little);
  direction[velocity] = corner.heading * sign;
  if (way[parameter] != 0)  // along which the corner moves
    direction[parameter] = -corner.heading * std::abs(unit) * (corner.there - corner.here) / way[parameter];
  const auto at = corrected(equations, guess, direction, tolerance);
  if (!at || !(largest(sum(*at, -1.0, guess)) <= largest(way))) return std::nullopt;
  const auto along = tangent(equations, *at, direction);
  if (!along) return std::nullopt;
  const Vector gone = sum(*at, -1.0, here.at);
  return CurvePoint{*at, *along, here.arclength + std::sqrt(product(gone, gone))};
}

}  // namespace clatter::branches
