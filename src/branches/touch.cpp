#include "branches/touch.hpp"

#include <cmath>
#include <numbers>

#include "branches/flight.hpp"

namespace clatter::branches {
namespace {

/// The only impact of a mirrored orbit that is just born, at a phase of -pi ... pi.
Orbit near_phase_zero(Orbit orbit) {
  double& phase = orbit.impacts[0].phase;
  phase = std::remainder(phase, 2 * std::numbers::pi);
  return orbit;
}

/// The graze that two events of an orbit become, of which number `first` is the earlier one.
void merge(Touch& touch, std::size_t first) {
  const OrbitImpact one = touch.orbit.impact(first), other = touch.orbit.impact(first + 1);
  OrbitImpact& graze = touch.orbit.impacts[first];
  graze.phase = (one.phase + other.phase) / 2;
  graze.before = one.event == Event::touch ? 0.0 : (one.before + other.before) / 2;
  graze.event = other.event;  // after which the arc is that before the first
  const std::size_t second = (first + 1) % touch.orbit.size();
  touch.orbit.impacts.erase(touch.orbit.impacts.begin() + static_cast<std::ptrdiff_t>(second));
  touch.impact = second < first ? first - 1 : first;
}

/// Acceleration at an event, that of the free motion.
double acceleration(const Parameters<double>& p, const OrbitImpact& event, double offset) {
  const LeadingForce<double> force = p.force();
  return force.amplitude * std::sin(event.phase + force.lead) + p.load - 2 * p.h * event.before -
         p.k * (p.position(event.side) + offset);
}

}  // namespace

Condition Touch::condition() const {
  const OrbitImpact& graze = orbit.impacts[impact];
  const bool within = graze.event != Event::impact && graze.before != 0 && !turns;
  return {within ? Condition::Kind::force : Condition::Kind::graze, 1, impact};
}

std::optional<Touch> touch_within(const OrbitEquations& equations, const Walk& walk, double step) {
  double good = 0.0, bad = step;
  std::optional<Violation> found;
  Touch touch{walk.here(), {}, {}};
  for (int halving = 0; halving < 40 && bad - good > 1e-7 * step; ++halving) {
    const double middle = halving == 0 ? bad : (good + bad) / 2;
    const auto point = walk.after(middle);
    if (!point) break;  // near a singular point of the equations
    if (const auto violated = violation(equations, point->at))
      bad = middle, found = violated, touch.beyond = *point;
    else
      good = middle, touch.last_good = *point;
  }
  if (!found) return std::nullopt;
  touch.orbit = equations.orbit_at(touch.beyond.at);
  touch.impact = found->impact;
  touch.appears = found->kind == Violation::Kind::passes_through;
  touch.turns = found->kind == Violation::Kind::pulls && presses(touch.orbit.impacts[touch.impact].event);
  if (touch.appears) {
    const bool first = touch.orbit.size() == 0;
    touch.impact = first ? 0 : found->impact + 1;
    touch.orbit = touch.orbit.with(found->turning, touch.impact);
    if (first && touch.orbit.mirrored) touch.orbit = near_phase_zero(touch.orbit);
  } else if (found->kind == Violation::Kind::ends_early) {
    merge(touch, found->impact);
  }
  return touch;
}

Orbit opened(const ShakenScene& scene, const Orbit& orbit, std::size_t graze, double advance) {
  const Parameters<double> p(scene);
  const OrbitImpact middle = orbit.impacts[graze];
  const double relaxation = p.soft_stop(middle.side).relaxation(), time = advance / p.nu;
  OrbitImpact begin = middle, end = middle;
  const double a = acceleration(p, middle, -relaxation * middle.before);
  double before = time / 2;  // from the beginning to the extremum
  if (middle.event == Event::separation && middle.before == 0) {
    // v t + a t^2/2 + r (v + a t) = 0, the end of a contact that begins with v: the mass turns after the time -v/a
    before = time * (time / 2 + relaxation) / (time + relaxation);
    begin.event = Event::touch;
  } else {
    begin.event = middle.event == Event::separation ? Event::renewal : Event::separation;
  }
  begin.phase = middle.phase - p.nu * before, begin.before = middle.before - a * before;
  end.phase = begin.phase + advance, end.before = begin.before + a * time;
  Orbit out = orbit;
  out.impacts[graze] = end;
  return out.with(begin, graze);
}

Orbit turned(Orbit orbit, std::size_t event) {
  Event& kind = orbit.impacts[event].event;
  kind = kind == Event::touch ? Event::renewal : Event::touch;
  return orbit;
}

}  // namespace clatter::branches
