#include "branches/walk/graze.hpp"

#include <algorithm>
#include <cmath>

#include "branches/equations/flight.hpp"
#include "branches/equations/newton.hpp"
#include "branches/walk/violation.hpp"

namespace clatter::branches {
namespace {

std::optional<ExactGraze> solved(const Equations& equations, const FollowedScene& near, const Graze& graze,
                                 double within, double tolerance) {
  const OrbitEquations there = equations(graze.orbit, {graze.condition});
  const Vector guess = there.unknowns_of(near, graze.orbit);
  const auto exact = solution(there, guess, tolerance);
  if (!exact || std::abs(exact->back() - guess.back()) > within) return std::nullopt;
  ExactGraze at{there.scene_at(*exact), there.orbit_at(*exact), graze.event};
  OrbitEvent& event = at.orbit.events[graze.event];
  if (!is_impact(event.kind) && graze.condition.kind == Condition::Kind::graze) event.before = 0;
  return at;
}

/// Several grazes at once as the one of a motion that repeats sooner, or is symmetric, or touches both stops.
Graze once_of(Graze graze, double slow, bool symmetric_scene) {
  const Event::Kind grazes = graze.orbit.events[graze.event].kind;
  if (graze.condition.kind != Condition::Kind::graze || (grazes != Event::Kind::separation && !is_impact(grazes)))
    return graze;
  for (std::size_t i = graze.orbit.size(); i-- > 0;) {
    const std::size_t next = (i + 1) % graze.orbit.size();
    const Event::Kind kind = graze.orbit.events[i].kind;
    const bool is_contact = kind == Event::Kind::touch && next != graze.event;
    if (i == graze.event || !(is_contact || is_impact(kind))) continue;
    if (std::abs(graze.orbit.events[i].before) > slow) continue;
    for (const std::size_t each : is_contact ? std::vector{std::max(i, next), std::min(i, next)} : std::vector{i}) {
      graze.orbit.events.erase(graze.orbit.events.begin() + static_cast<std::ptrdiff_t>(each));
      graze.event -= each < graze.event;
    }
  }
  graze.orbit.events[graze.event].before = 0;
  graze.orbit = graze.orbit.once_with_graze(graze.event, symmetric_scene);
  const auto at = std::ranges::find_if(
      graze.orbit.events, [&](const OrbitEvent& event) { return event.kind == grazes && event.before == 0; });
  graze.event = static_cast<std::size_t>(at - graze.orbit.events.begin());
  graze.condition.event = graze.event;
  return graze;
}

/// Whether one graze is nearer to a scene than another one, by more than rounding. All slow contacts of a motion may
/// vanish at once, or the other ones are slow there, too, and the motion without them grazes somewhere near.
bool is_nearer(const ExactGraze& one, const ExactGraze& other, const FollowedScene& scene,
               const OrbitEquations::Axis& axis) {
  constexpr double rounding = 1e-9;
  const auto off = [&](const FollowedScene& there) {
    return std::abs(value_of(there, axis.parameter) - value_of(scene, axis.parameter)) / axis.unit;
  };
  return off(one.scene) + rounding < off(other.scene);
}

}  // namespace

std::optional<ExactGraze> exact_graze(const Equations& equations, const FollowedScene& near, Graze graze, double slow,
                                      bool symmetric_scene, double within, double tolerance) {
  const auto exact = solved(equations, near, graze, within, tolerance);
  if (exact) graze.orbit = exact->orbit;
  if (exact && !graze.orbit.meets_soft_stop()) return exact;
  const Graze once = once_of(graze, slow, symmetric_scene);
  if (exact && once.orbit.size() == graze.orbit.size()) return exact;
  auto joined = solved(equations, near, once, within, tolerance);
  if (!joined || (exact && is_nearer(*exact, *joined, near, equations(once.orbit, {}).axes().front()))) return exact;
  joined->joins = true;
  return joined;
}

std::optional<Vector> direction_into_motion(const OrbitEquations& equations, const Vector& from,
                                            const std::vector<Vector>& directions, double tolerance) {
  for (const double s : {1e-5, 1e-4, 1e-3, 1e-2})
    for (const Vector& direction : directions) {
      const auto at = corrected(equations, sum(from, s, direction), direction, tolerance);
      if (at && !violation(equations, *at)) return direction;
    }
  return std::nullopt;
}

Orbit turned(Orbit orbit, std::size_t event) {
  Event::Kind& kind = orbit.events[event].kind;
  kind = kind == Event::Kind::touch ? Event::Kind::renewal : Event::Kind::touch;
  return orbit;
}

}  // namespace clatter::branches
