#include "branches/walk/touch.hpp"

#include <cmath>
#include <numbers>

namespace clatter::branches {
namespace {

/// The only impact of a mirrored orbit that is just born, at a phase of -pi ... pi.
Orbit near_phase_zero(Orbit orbit) {
  double& phase = orbit.events[0].phase;
  phase = std::remainder(phase, 2 * std::numbers::pi);
  return orbit;
}

}  // namespace

Orbit with_graze(Orbit orbit, std::size_t first) {
  const OrbitEvent one = orbit.event(first), other = orbit.event(first + 1);
  OrbitEvent& graze = orbit.events[first];
  graze.phase = (one.phase + other.phase) / 2;
  graze.before = one.kind == Event::Kind::touch ? 0.0 : (one.before + other.before) / 2;
  graze.kind = presses(other.kind) ? Event::Kind::renewal : other.kind;  // after which the arc is that before the first
  const std::size_t second = (first + 1) % orbit.size();
  orbit.events.erase(orbit.events.begin() + static_cast<std::ptrdiff_t>(second));
  return orbit;
}

Graze Touch::graze() const {
  const OrbitEvent& grazes = orbit.events[event];
  const bool within = !is_impact(grazes.kind) && grazes.before != 0 && !turns;
  return {orbit, event, {within ? Condition::Kind::force : Condition::Kind::graze, 1, event}};
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
  touch.event = found.event;
  touch.appears = found.kind == Violation::Kind::passes_through;
  touch.turns = found.kind == Violation::Kind::pulls && presses(touch.orbit.events[touch.event].kind);
  touch.halts = has_friction(equations.scene_at(between.beyond.at).friction) &&
                found.kind != Violation::Kind::ends_early &&
                is_impact(touch.appears ? found.turning.kind : touch.orbit.events[touch.event].kind);
  if (touch.appears && touch.halts) {
    touch.event = (found.event + 1) % touch.orbit.size();
    OrbitEvent& halt = touch.orbit.events[touch.event];
    halt = {opposite(halt.side), halt.phase};
  } else if (touch.appears) {
    const bool first = touch.orbit.size() == 0;
    touch.event = first ? 0 : found.event + 1;
    touch.orbit = touch.orbit.with(found.turning, touch.event);
    if (first && touch.orbit.mirrored) touch.orbit = near_phase_zero(touch.orbit);
  } else if (found.kind == Violation::Kind::ends_early) {
    const std::size_t first = found.event;
    touch.orbit = with_graze(touch.orbit, first), touch.vanishes = first;
    touch.event = first + 1 < equations.shape().size() ? first : first - 1;
  }
  return touch;
}

std::optional<Touch> touch_within(const OrbitEquations& equations, const Walk& walk, double step) {
  const auto between = narrowed(equations, walk, step);
  return between ? std::optional(touch_of(equations, *between)) : std::nullopt;
}

Orbit halting_at_stop(const FollowedScene& scene, Orbit orbit, std::size_t event) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  OrbitEvent& halt = orbit.events[event];
  const double place = p.position(halt.side) - p.middle();
  halt = {opposite(halt.side), halt.phase, 0.0, Event::Kind::reversal, 0.0, place, {}, Side::none};
  return orbit;
}

Orbit with_impact_at_graze(const FollowedScene& scene, const Orbit& orbit, std::optional<std::size_t> graze) {
  if (!graze || orbit.events[*graze].kind != Event::Kind::reversal) return orbit;
  const Side stop = orbit.heading_before(*graze);
  if (is_soft(scene.stops, stop)) return orbit;
  Orbit with = orbit;
  with.events[*graze] = {stop, orbit.events[*graze].phase};
  return with;
}

}  // namespace clatter::branches
