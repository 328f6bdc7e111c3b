#include "branches/touch.hpp"

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
  if (touch.appears) {
    const bool first = touch.orbit.size() == 0;
    touch.impact = first ? 0 : found->impact + 1;
    touch.orbit = touch.orbit.with(found->turning, touch.impact);
    if (first && touch.orbit.mirrored) touch.orbit = near_phase_zero(touch.orbit);
  }
  return touch;
}

}  // namespace clatter::branches
