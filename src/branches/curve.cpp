#include "branches/curve.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "branches/measures.hpp"
#include "branches/touch.hpp"

namespace clatter::branches {
namespace {

constexpr std::size_t along_axis = 0, across_axis = 1;

std::size_t slowest_impact(const Orbit& orbit) {
  const auto slow =
      std::ranges::min_element(orbit.impacts, {}, [](const OrbitImpact& impact) { return std::abs(impact.before); });
  return static_cast<std::size_t>(slow - orbit.impacts.begin());
}

Condition condition_of(SpecialKind kind, const Orbit& orbit) {
  if (kind == SpecialKind::graze) return {Condition::Kind::graze, 1, slowest_impact(orbit)};
  return {Condition::Kind::multiplier, kind == SpecialKind::fold ? 1 : -1};
}

class CurveFollower {
 public:
  CurveFollower(const point::Problem& problem, const BranchSettings& settings)
      : problem_(problem),
        settings_(settings),
        ranges_{settings.range, settings.across_range},
        axes_{{settings.along, width_of(along_axis)}, {*settings.across, width_of(across_axis)}} {}

  Branches run() {
    const double across = value_of(problem_, *settings_.across);
    if (!(across >= ranges_[across_axis][0] && across <= ranges_[across_axis][1]))
      throw StartError("the start lies outside branch.across_range; give scene." +
                       std::string(sweep::key_of(*settings_.across)) + " a value within it");
    for (SpecialPoint& special : follow_branches(problem_, settings_).special) {
      if (name_of(special.kind) != settings_.curve || special.at.orbit.rests()) continue;
      Orbit& orbit = special.at.orbit;
      if (special.kind == SpecialKind::graze)
        orbit = orbit.once_with_graze(slowest_impact(orbit), is_symmetric(special.at.scene));
      starts_.push_back(std::move(special));
    }
    if (starts_.empty())
      throw StartError("the branch has no " + settings_.curve +
                       "; widen branch.range, raise branch.switch, or begin "
                       "on another motion");
    for (const SpecialPoint& start : starts_)
      if (!is_known(start) && !budget_is_spent()) follow(start);
    return std::move(result_);
  }

 private:
  double width_of(std::size_t axis) const {
    const double width = ranges_[axis][1] - ranges_[axis][0];
    return std::isfinite(width) ? width : std::max(0.1, std::abs(value_of(problem_, *settings_.across)));
  }
  [[nodiscard]] OrbitEquations equations_for(const Orbit& orbit, std::vector<Condition> conditions) const {
    return {problem_, orbit, axes_, speed_unit_, std::move(conditions)};
  }
  [[nodiscard]] double parameter(const Vector& at, std::size_t axis) const {
    return at[at.size() - 2 + axis] * axes_[axis].unit;
  }

  /// Whether a curve that was followed goes through a special point.
  [[nodiscard]] bool is_known(const SpecialPoint& start) const {
    return std::ranges::any_of(result_.special, [&](const SpecialPoint& known) { return same(known, start); });
  }
  [[nodiscard]] bool same(const SpecialPoint& a, const SpecialPoint& b) const {
    if (a.kind != b.kind) return false;
    for (const auto& [parameter, unit] : axes_)
      if (std::abs(value_of(a.at.scene, parameter) - value_of(b.at.scene, parameter)) > 1e-8 * unit) return false;
    const PhasePoint one = state_at_phase_zero(a.at.scene, a.at.orbit),
                     other = state_at_phase_zero(b.at.scene, b.at.orbit);
    return std::hypot(one.x - other.x, one.v - other.v) <= 1e-5 * speed_unit_;
  }

  [[nodiscard]] BranchPoint point_of(const OrbitEquations& equations, const CurvePoint& point) const {
    BranchPoint out{curve_, point.arclength, equations.scene_at(point.at), equations.orbit_at(point.at), false, {}, {}};
    const auto grazing = equations.grazing();  // the multipliers are those without the impact that has no speed
    const Multipliers of = multipliers(out.scene, grazing ? without_graze(out.orbit, *grazing) : out.orbit);
    out.stable = of.stable, out.multiplier_re = of.re, out.multiplier_im = of.im;
    return out;
  }

  [[nodiscard]] bool budget_is_spent() const {
    return result_.points.size() >= static_cast<std::size_t>(settings_.max_points);
  }
  void add(const BranchPoint& point) { result_.points.push_back(point); }
  void note(SpecialKind kind, const BranchPoint& at) {
    const SpecialPoint special{kind, at, {curve_}};
    if (!is_known(special)) result_.special.push_back(special);
  }
  void end(const BranchPoint& last, std::string reason, bool failed = false) {
    result_.ends.push_back({curve_, value_of(last.scene, settings_.along), std::move(reason), failed});
  }

  void follow(const SpecialPoint& from) {
    curve_ = result_.ends.empty() ? 0 : result_.ends.back().branch + 1;
    kind_ = from.kind, speed_unit_ = 0;
    for (const OrbitImpact& impact : from.at.orbit.impacts)
      speed_unit_ = std::max(speed_unit_, std::abs(impact.before));
    if (speed_unit_ < 1e-6) speed_unit_ = std::max(1e-3, std::abs(problem_.oscillator.forcing));
    const OrbitEquations equations = equations_for(from.at.orbit, {condition_of(from.kind, from.at.orbit)});
    Vector across(equations.unknowns(), 0.0);
    across.back() = 1;
    CurvePoint start{equations.unknowns_of(from.at.scene, from.at.orbit), {}, 0.0};
    const auto at = corrected(equations, start.at, across, settings_.tolerance);
    const auto tangent_there = at ? tangent(equations, *at, across) : std::nullopt;
    if (!tangent_there) return end(from.at, "Newton's method does not converge at its start", true);
    start.at = *at, start.tangent = *tangent_there;
    const std::size_t first_point = result_.points.size(), first_special = result_.special.size();
    CurvePoint back = start;
    for (double& x : back.tangent) x = -x;
    const bool closed = walk(equations, back);
    std::reverse(result_.points.begin() + static_cast<std::ptrdiff_t>(first_point), result_.points.end());
    for (std::size_t i = first_point; i < result_.points.size(); ++i) result_.points[i].arclength *= -1;
    for (std::size_t i = first_special; i < result_.special.size(); ++i) result_.special[i].at.arclength *= -1;
    add(point_of(equations, start));
    note(from.kind, point_of(equations, start));
    if (!closed && !budget_is_spent()) walk(equations, start);
  }

  /// Returns true if the curve is closed.
  bool walk(const OrbitEquations& equations, const CurvePoint& start) {
    Walk walk(equations, start, {settings_.tolerance, settings_.largest_step});
    BranchPoint last = point_of(equations, start);
    for (;;) {
      if (budget_is_spent()) return end(last, "branch.max_points is spent", true), false;
      const auto next = walk.next();
      if (!next) return end(last, "no step leads on", true), false;
      const double step = next->arclength - walk.here().arclength;
      for (const std::size_t axis : {along_axis, across_axis})
        for (const double bound : ranges_[axis])
          if ((parameter(next->at, axis) > bound) == (bound == ranges_[axis][1]) && parameter(next->at, axis) != bound)
            return end_at_bound(equations, walk, axis, bound, step), false;
      if (violation(equations, next->at)) return end_in_graze(equations, walk, step), false;
      special_between(equations, walk, step);
      note_start_between(equations, walk, step);
      if (walk.passes(start, *next)) {
        CurvePoint closing = start;
        closing.arclength = next->arclength;
        return add(point_of(equations, closing)), end(last, "closed"), true;
      }
      walk.move_to(*next);
      last = point_of(equations, *next);
      add(last);
    }
  }

  void end_at_bound(const OrbitEquations& equations, const Walk& walk, std::size_t axis, double bound, double step) {
    auto zero = walk.zero([&](const CurvePoint& p) { return parameter(p.at, axis) - bound; }, step);
    if (!zero) return end(point_of(equations, walk.here()), "no step leads on", true);
    zero->at[zero->at.size() - 2 + axis] = bound / axes_[axis].unit;  // R = 0 less a rounding would be no impact
    const double length = zero->arclength - walk.here().arclength;
    if (violation(equations, zero->at)) return end_in_graze(equations, walk, length);
    special_between(equations, walk, length);
    note_start_between(equations, walk, length);
    const BranchPoint last = point_of(equations, *zero);
    add(last), end(last, "range");
  }

  /// The curve ends where a turning point touches a stop, too, or its own slowest impact vanishes: a resonant graze,
  /// in which curves of multipliers +1 and -1 meet that of the graze.
  void end_in_graze(const OrbitEquations& equations, const Walk& walk, double step) {
    const auto touch = touch_within(equations, walk, step);
    if (!touch) return end(point_of(equations, walk.here()), "no step leads on", true);
    special_between(equations, walk, touch->last_good.arclength - walk.here().arclength);
    Condition condition = equations.conditions().front();
    const bool of_multiplier = condition.kind == Condition::Kind::multiplier;
    if (touch->appears && of_multiplier) condition.without = touch->impact;
    if (touch->appears && !of_multiplier && touch->impact <= condition.impact) ++condition.impact;
    BranchPoint last = point_of(equations, touch->last_good);
    const Scene near = equations.scene_at(touch->beyond.at);
    SpecialKind kind = of_multiplier && !touch->appears ? SpecialKind::resonant_graze : SpecialKind::graze;
    auto exact = solved({condition, {Condition::Kind::graze, 1, touch->impact}}, near, touch->orbit);
    for (const bool symmetric : {is_symmetric(near), false}) {
      if (exact) break;
      // several speeds vanish at once and leave motion that repeats sooner: its resonance tells where
      const Orbit last_left = with_one_slow_impact(touch->orbit);
      const Orbit once = last_left.once_with_graze(slowest_impact(last_left), symmetric);
      exact = solved({{Condition::Kind::graze, 1, slowest_impact(once)}, {Condition::Kind::multiplier, 1}}, near, once);
      kind = SpecialKind::resonant_graze;
    }
    if (!exact) return add(last), end(last, "a contact that no graze explains", true);
    std::tie(last.scene, last.orbit) = *exact;
    note(kind, last);
    if (touch->appears && kind == SpecialKind::graze) last.orbit = last.orbit.without(touch->impact);
    add(last), end(last, std::string(name_of(kind)));
  }

  /// The solution of an orbit's equations with two conditions near a guess; nothing if there is none near.
  [[nodiscard]] std::optional<std::pair<Scene, Orbit>> solved(std::vector<Condition> conditions, const Scene& scene,
                                                              const Orbit& orbit) const {
    const OrbitEquations equations = equations_for(orbit, std::move(conditions));
    const Vector guess = equations.unknowns_of(scene, orbit);
    const auto at = solution(equations, guess, settings_.tolerance);
    if (!at) return std::nullopt;
    for (const std::size_t axis : {along_axis, across_axis})
      if (std::abs(parameter(*at, axis) - parameter(guess, axis)) > settings_.largest_step * axes_[axis].unit)
        return std::nullopt;
    return std::pair(equations.scene_at(*at), equations.orbit_at(*at));
  }

  /// Without all impacts that have hardly any speed but one.
  [[nodiscard]] Orbit with_one_slow_impact(Orbit orbit) const {
    const std::size_t kept = slowest_impact(orbit);
    for (std::size_t i = orbit.size(); i-- > 0;)
      if (i != kept && std::abs(orbit.impacts[i].before) < 1e-2 * speed_unit_) orbit = orbit.without(i);
    return orbit;
  }

  /// The special point of a branch along the first parameter, at the scene's value of the second, within a step.
  void note_start_between(const OrbitEquations& equations, const Walk& walk, double step) {
    const double across = value_of(problem_, *settings_.across);
    const auto zero = walk.zero([&](const CurvePoint& p) { return parameter(p.at, across_axis) - across; }, step);
    if (zero) note(kind_, point_of(equations, *zero));
  }

  /// Cusps and resonant grazes within a step.
  void special_between(const OrbitEquations& equations, const Walk& walk, double step) {
    const auto next = walk.after(step);
    if (!next) return;
    const auto zero_of = [&](const TestFunction& test) -> std::optional<CurvePoint> {
      if ((test(walk.here()) < 0) == (test(*next) < 0)) return std::nullopt;
      return walk.zero(test, step);
    };
    if (!equations.grazing()) {
      // both parameters turn back at once
      const std::size_t last = equations.unknowns() - 1;
      const Vector& here = walk.here().tangent;
      const auto turned = zero_of(
          [&](const CurvePoint& p) { return p.tangent[last - 1] * here[last - 1] + p.tangent[last] * here[last]; });
      if (turned &&
          std::hypot(turned->tangent[last - 1], turned->tangent[last]) < 1e-5 * std::hypot(here[last - 1], here[last]))
        note(SpecialKind::cusp, point_of(equations, *turned));
      return;
    }
    for (const int periods : {1, 2, 3, 4}) {
      if (periods > 1 && equations.shape().mirrored) break;
      const auto resonant = zero_of([&](const CurvePoint& p) { return resonance(equations, p.at, periods); });
      if (!resonant) continue;
      BranchPoint at = point_of(equations, *resonant);
      at.orbit = grazing_once_in(at.orbit, *equations.grazing(), periods);
      note(SpecialKind::resonant_graze, at);
    }
  }

  /// Zero in a resonant graze: the nth iterate of the motion's map has no term in the square root of the distance from
  /// the graze (Simpson & Ghosh 2026).
  static double resonance(const OrbitEquations& equations, const Vector& at, int n) {
    const Scene scene = equations.scene_at(at);
    const Orbit orbit = equations.orbit_at(at);
    if (n == 1) {
      const ImpactMap map = impact_map(scene, orbit);
      return map.numerator[0][0] + map.numerator[1][1];
    }
    // the element of M^n from velocity to displacement: sin(n phi) / sin(phi) times that of M, cos(phi) = tr M / 2
    // over the root of the determinant
    const ImpactMap map = impact_map(scene, without_graze(orbit, *equations.grazing()));
    const double square = map.trace() * map.trace(), factor = n == 2 ? 0 : n == 3 ? 1 : 2;
    return n == 2 ? map.trace() : square - factor * map.determinant;
  }

  static Orbit without_graze(const Orbit& orbit, std::size_t graze) {
    const Orbit without = orbit.without(graze);
    return without.size() > 0 ? without : Orbit{}.half_if_same(0.0, orbit.mirrored);
  }

  /// The motion over n periods, with its graze in the first of them alone.
  static Orbit grazing_once_in(const Orbit& orbit, std::size_t graze, int n) {
    if (n == 1) return orbit;
    Orbit many = orbit.repeated(n);
    for (std::size_t i = many.size(); i-- > orbit.size();)
      if (i % orbit.size() == graze) many = many.without(i);
    return many;
  }

  point::Problem problem_;
  BranchSettings settings_;
  std::array<std::array<double, 2>, 2> ranges_;  ///< [axis]: low and high
  std::vector<OrbitEquations::Axis> axes_;
  double speed_unit_ = 0.0;
  std::size_t curve_ = 0;
  SpecialKind kind_ = SpecialKind::fold;  ///< of the points of the curve
  std::vector<SpecialPoint> starts_;
  Branches result_;
};

}  // namespace

Branches follow_curves(const point::Problem& problem, const BranchSettings& settings) {
  return CurveFollower(problem, settings).run();
}

}  // namespace clatter::branches
