#include "branches/walk/touch.hpp"

#include <cmath>
#include <numbers>

namespace clatter::branches {
namespace {

/// The only impact of a mirrored orbit that is just born, at a phase of -pi ... pi.
Orbit near_phase_zero(Orbit orbit) {
  double& phase = orbit.impacts[0].phase;
  phase = std::remainder(phase, 2 * std::numbers::pi);
  return orbit;
}

}  // namespace

Orbit with_graze(Orbit orbit, std::size_t first) {
  const OrbitImpact one = orbit.impact(first), other = orbit.impact(first + 1);
  OrbitImpact& graze = orbit.impacts[first];
  graze.phase = (one.phase + other.phase) / 2;
  graze.before = one.event == EventKind::touch ? 0.0 : (one.before + other.before) / 2;
  graze.event =
      presses(other.event) ? EventKind::renewal : other.event;  // after which the arc is that before the first
  const std::size_t second = (first + 1) % orbit.size();
  orbit.impacts.erase(orbit.impacts.begin() + static_cast<std::ptrdiff_t>(second));
  return orbit;
}

Graze Touch::graze() const {
  const OrbitImpact& event = orbit.impacts[impact];
  const bool within = event.event != EventKind::impact && event.before != 0 && !turns;
  return {orbit, impact, {within ? Condition::Kind::force : Condition::Kind::graze, 1, impact}};
}

std::optional<Narrowed> narrowed(const OrbitEquations& equations, const Walk& walk, double step) {
  double good = 0.0, bad = step;
  std::optional<Violation> found;
  Narrowed between{walk.here(), {}, {}};
  for (int halving = 0; halving < 40 && bad - good > 1e-7 * step; ++halving) {
    const double middle = halving == 0 ? bad : (good + bad) / 2;
    const auto point = walk.after(middle);
    if (!point) break;  // near a singular point of the equations
    if (const auto violated = violation(equations, point->at))
      bad = middle, found = violated, between.beyond = *point;
    else
      good = middle, between.last_good = *point;
  }
  if (!found) return std::nullopt;
  between.violated = *found;
  return between;
}

Touch touch_of(const OrbitEquations& equations, const Narrowed& between) {
  Touch touch{between.last_good, between.beyond, equations.orbit_at(between.beyond.at)};
  const Violation& found = between.violated;
  touch.impact = found.impact;
  touch.appears = found.kind == Violation::Kind::passes_through;
  touch.turns = found.kind == Violation::Kind::pulls && presses(touch.orbit.impacts[touch.impact].event);
  touch.halts = has_friction(equations.scene_at(between.beyond.at).friction);
  if (touch.appears && touch.halts) {
    touch.impact = (found.impact + 1) % touch.orbit.size();
    OrbitImpact& halt = touch.orbit.impacts[touch.impact];
    halt = {opposite(halt.side), halt.phase};
  } else if (touch.appears) {
    const bool first = touch.orbit.size() == 0;
    touch.impact = first ? 0 : found.impact + 1;
    touch.orbit = touch.orbit.with(found.turning, touch.impact);
    if (first && touch.orbit.mirrored) touch.orbit = near_phase_zero(touch.orbit);
  } else if (found.kind == Violation::Kind::ends_early) {
    const std::size_t first = found.impact;
    touch.orbit = with_graze(touch.orbit, first), touch.vanishes = first;
    touch.impact = first + 1 < equations.shape().size() ? first : first - 1;
  }
  return touch;
}

std::optional<Touch> touch_within(const OrbitEquations& equations, const Walk& walk, double step) {
  const auto between = narrowed(equations, walk, step);
  return between ? std::optional(touch_of(equations, *between)) : std::nullopt;
}

Orbit halting_at_stop(const FollowedScene& scene, Orbit orbit, std::size_t impact) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  OrbitImpact& halt = orbit.impacts[impact];
  halt = {opposite(halt.side), halt.phase, 0.0, 0.0, EventKind::reversal, p.position(halt.side) - p.middle()};
  return orbit;
}

}  // namespace clatter::branches
