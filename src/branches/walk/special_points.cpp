#include "branches/walk/special_points.hpp"

#include <algorithm>
#include <cmath>

#include "branches/equations/housing_multipliers.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"

namespace clatter::branches {

namespace {

/// Whether a motion is its own mirror image, but not kept as half of it: its stops, of which it meets none, are no
/// images of each other.
bool is_image_of_itself(const Orbit& orbit) {
  constexpr double same = 1e-6;
  return !orbit.mirrored && !orbit.meets_stops() && orbit.half_if_same(same, true).mirrored;
}

}  // namespace

std::vector<FoundPoint> special_points_within(const OrbitEquations& equations, const Walk& walk, double step,
                                              const StepEnds& ends, const observables::Observe& observe) {
  const bool is_first = ends.begins_in_special;
  std::vector<FoundPoint> found;
  const auto there = walk.after(step);
  if (!there) return found;
  const auto look_between = [&](double from, double to, SpecialKind kind, const TestFunction& test, bool only_down) {
    const auto first = walk.after(from), last = to == step ? there : walk.after(to);
    if (!first || !last) return;
    const double a = test(*first), b = test(*last);
    if ((a < 0) == (b < 0) || (only_down && a < 0)) return;
    if (const auto zero = walk.zero(test, to, from)) found.push_back({kind, *zero});
  };
  const auto look = [&](SpecialKind kind, const TestFunction& test, bool only_down, double from = 0.0) {
    look_between(from, step, kind, test, only_down);
  };
  // a branch begins across the parameter if it is born in a flip or a loss of symmetry: that is no fold of it, and as
  // all its measures turn round there, no maximum; if a halt of no length begins there, derivatives have no digits
  const bool begins_to_halt = is_first && std::ranges::any_of(equations.shape().events, halts, &OrbitEvent::kind);
  const double turns_until = is_first ? step / 8 : 0.0, begin = begins_to_halt ? 1e-3 * step : 0.0;
  look(
      SpecialKind::fold, [](const CurvePoint& p) { return p.tangent.back(); }, false,
      ends.begins_across || begins_to_halt ? turns_until : 0.0);
  const bool has_impacts = equations.shape().size() > 0;
  const SpecialKind loses = equations.shape().mirrored ? SpecialKind::symmetry_breaking : SpecialKind::flip;
  if (has_impacts && has_loose_mass(equations.scene_at(there->at).loose)) {
    const auto characteristic = [&](const CurvePoint& p) {
      return housing_characteristic(equations.scene_at(p.at), equations.orbit_at(p.at));
    };
    look(
        loses, [&](const CurvePoint& p) { return characteristic(p).at(-1); }, false, begin);
    look(
        SpecialKind::neimark_sacker, [&](const CurvePoint& p) { return characteristic(p).distance_to_unit_product(); },
        false, begin);
    const bool has_fold = std::ranges::count(found, SpecialKind::fold, &FoundPoint::kind) > 0;
    if (!has_fold && is_image_of_itself(equations.orbit_at(walk.here().at)))
      look(
          SpecialKind::symmetry_breaking, [&](const CurvePoint& p) { return characteristic(p).at(1); }, false, begin);
    std::erase_if(found, [&](const FoundPoint& f) {  // two real multipliers with such a product are no bifurcation
      return f.kind == SpecialKind::neimark_sacker && !characteristic(f.point).would_be_complex();
    });
  } else if (has_impacts) {
    // where a slip to a stick vanishes, a multiplier may come to -1 as its length squared: no further than to rounding
    const double rounding = equations.shape().halts() ? 1e-8 : 0.0;
    const auto distance = [&, rounding](const CurvePoint& p) {
      const ImpactMap map = impact_map(equations.scene_at(p.at), equations.orbit_at(p.at));
      const double off = map.distance_to(-1);
      return std::abs(off) <= rounding * std::abs(map.denominator) ? rounding * map.denominator : off;
    };
    look(loses, distance, false, begin);
  }
  // so near to a graze, over the range, rounding decides on which side of it they are, or whether they are at all
  constexpr double beside_graze = 1e-12;
  std::erase_if(found, [&](const FoundPoint& f) {
    const auto is_beside = [&](const CurvePoint& graze) {
      return std::abs(f.point.at.back() - graze.at.back()) <= beside_graze;
    };
    return (is_first && is_beside(walk.here())) || (ends.ends_in_graze && is_beside(*there));
  });
  if (has_impacts || equations.shape().pressed != Side::none) {
    const double to = ends.ends_in_graze ? step - 1e-2 * step : step;
    const auto look_for_maximum = [&](SpecialKind of, Along (*measure)(const Moving&)) {
      const auto at = [&, measure](const CurvePoint& p) { return measure(moving(equations, p.at, p.tangent)); };
      if (!changes(at(walk.here())) && !changes(at(*there))) return;
      look_between(
          turns_until, to, of, [at](const CurvePoint& p) { return at(p).slope[0]; }, true);
    };
    look_for_maximum(SpecialKind::impact_speed, impact_speed);
    if (observe.energy) look_for_maximum(SpecialKind::impact_power, impact_power);
    if (observe.harmonics > 0) look_for_maximum(SpecialKind::harmonic, harmonic);
  }
  std::ranges::sort(found, {}, [](const FoundPoint& f) { return f.point.arclength; });
  return found;
}

}  // namespace clatter::branches
