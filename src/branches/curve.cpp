#include "branches/curve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include "branches/curve_graze.hpp"
#include "branches/equations/housing_multipliers.hpp"
#include "branches/measures/measures.hpp"
#include "branches/record.hpp"
#include "branches/simultaneous_end.hpp"
#include "branches/walk/change_on_curve.hpp"
#include "branches/walk/rebound_threshold.hpp"
#include "branches/walk/resonant_graze.hpp"
#include "branches/walk/touch.hpp"

namespace clatter::branches {
namespace {

constexpr std::size_t along_axis = 0, across_axis = 1;

Condition condition_of(const SpecialPoint& special) {
  if (special.kind == SpecialKind::graze) return special.condition;
  if (special.kind == SpecialKind::neimark_sacker) return {Condition::Kind::unit_product};
  return {Condition::Kind::multiplier, special.kind == SpecialKind::fold ? 1 : -1};
}

class CurveFollower {
 public:
  CurveFollower(const StartProblem& problem, const BranchSettings& settings)
      : problem_(damped_by(damped_by(problem, settings.along), *settings.across)),
        settings_(settings),
        ranges_{settings.range, settings.across_range},
        axes_{{settings.along, width_of(along_axis)}, {*settings.across, width_of(across_axis)}},
        record_(axes_, settings.max_points) {}

  Branches run() {
    if (settings_.along.role() == Role::shaking && settings_.across->role() == Role::shaking)
      throw SettingError("stops and base can't be shaken at once; expected another branch.across");
    require_start_in_range(problem_, *settings_.across, settings_.across_range, "across");
    Branches along = follow_branches(problem_, settings_);
    std::erase_if(along.ends, [](const BranchEnd& end) { return !end.failed; });
    std::erase_if(along.special, [&](const SpecialPoint& special) { return name_of(special.kind) != settings_.curve; });
    if (along.special.empty()) throw StartError("the branch has no " + settings_.curve + way_out(along));
    std::erase_if(along.special, [](const SpecialPoint& special) { return special.at.orbit.rests(); });
    if (along.special.empty())
      throw StartError("each " + settings_.curve +
                       " on the branch is of motion that rests, whose special points begin no curves; begin on another "
                       "motion");
    for (SpecialPoint& start : along.special) {
      if (start.kind == SpecialKind::graze) make_once(start, keeps_symmetry_of(start.at.scene));
      if (!record_.knows(start.kind, start.at) && !record_.is_full()) follow(start);
    }
    Branches found = record_.take();
    found.left_out = along.left_out, found.letters = along.letters;
    found.ends.insert(found.ends.end(), along.ends.begin(), along.ends.end());
    return found;
  }

 private:
  /// Whether all scenes are symmetric if one is.
  [[nodiscard]] bool keeps_symmetry_of(const FollowedScene& scene) const {
    return is_symmetric(scene) && keeps_symmetry(scene, settings_.along) && keeps_symmetry(scene, *settings_.across);
  }
  double width_of(std::size_t axis) const {
    const double width = ranges_[axis][1] - ranges_[axis][0];
    if (std::isfinite(width)) return width;
    const double value = std::abs(value_of(problem_, *settings_.across));
    const double unit = factor_of(problem_.units, settings_.across->row().quantity);
    return problem_.units.is_si && value > 0 ? value : std::max(0.1 * unit, value);
  }
  /// Advice if the branches that could be followed have no point to begin with.
  [[nodiscard]] std::string way_out(const Branches& along) const {
    if (along.ends.empty()) return "; widen branch.range, raise branch.switch, or begin on another motion";
    return " up to its end at " + std::string(settings_.along.key()) + " = " +
           std::to_string(value_of(along.ends.front().scene, settings_.along)) + ": " + along.ends.front().reason;
  }
  [[nodiscard]] OrbitEquations equations_for(const Orbit& orbit, std::vector<Condition> conditions) const {
    return {problem_, orbit, axes_, speed_unit_, std::move(conditions)};
  }
  [[nodiscard]] Equations any_equations() const { return std::bind_front(&CurveFollower::equations_for, this); }
  /// A point of the curve, whose word has the letter of an impact without speed.
  [[nodiscard]] BranchPoint point_of(const OrbitEquations& equations, const CurvePoint& at) const {
    BranchPoint point = record_.point(equations, at);
    point.orbit = with_impact_at_graze(point.scene, point.orbit, equations.grazing());
    return point;
  }
  [[nodiscard]] double parameter(const Vector& at, std::size_t axis) const {
    return at[at.size() - 2 + axis] * axes_[axis].unit;
  }

  void follow(const SpecialPoint& from) {
    kind_ = from.kind, speed_unit_ = speed_scale(from.at.scene, from.at.orbit);
    record_.begin(speed_unit_);
    const OrbitEquations equations = equations_for(from.at.orbit, {condition_of(from)});
    Vector across(equations.unknowns(), 0.0);
    across.back() = 1;
    CurvePoint start{equations.unknowns_of(from.at.scene, from.at.orbit), {}, 0.0};
    const auto at = corrected(equations, start.at, across, settings_.tolerance);
    const auto tangent_there = at ? tangent(equations, *at, across) : std::nullopt;
    if (!tangent_there)
      return record_.fail(from.at, "Newton\'s method does not converge at its start; begin on another branch");
    start.at = *at, start.tangent = *tangent_there;
    CurvePoint back = start;
    for (double& x : back.tangent) x = -x;
    record_.walk_back();
    const bool closed = walk(equations, back);
    record_.turn_round();
    record_.add(point_of(equations, start));
    record_.note(from.kind, point_of(equations, start));
    if (!closed && !record_.is_full()) walk(equations, start);
  }

  /// Returns true if the curve is closed.
  bool walk(const OrbitEquations& equations, const CurvePoint& start) {
    Walk walk(equations, start, {settings_.tolerance, settings_.largest_step});
    BranchPoint last = point_of(equations, start);
    if (leaves_ranges(start)) return record_.end(last, "range"), false;
    for (;;) {
      if (record_.is_full()) return record_.fail(last, max_points_spent), false;
      const auto next = walk.next();
      if (!next) return end_near_graze(equations, walk.here(), no_step), false;
      const double step = next->arclength - walk.here().arclength;
      for (const std::size_t axis : {along_axis, across_axis})
        for (const double bound : ranges_[axis])
          if ((parameter(next->at, axis) > bound) == (bound == ranges_[axis][1]) && parameter(next->at, axis) != bound)
            return end_at_bound(equations, walk, axis, bound, step), false;
      if (violation(equations, next->at)) return end_in_graze(equations, walk, step), false;
      if (const auto end = strong_resonance(equations, walk, step))
        return end_at(SpecialKind::strong_resonance, *end), false;
      special_between(equations, walk, step);
      note_start_between(equations, walk, step);
      if (walk.passes(start, *next)) {
        CurvePoint closing = start;
        closing.arclength = next->arclength;
        return record_.add(point_of(equations, closing)), record_.end(last, "closed"), true;
      }
      walk.move_to(*next);
      last = point_of(equations, *next);
      record_.add(last);
    }
  }

  /// Whether a walk begins on a bound of a range, outwards.
  [[nodiscard]] bool leaves_ranges(const CurvePoint& start) const {
    for (const std::size_t axis : {along_axis, across_axis}) {
      const double at = parameter(start.at, axis), rounding = 1e-14 * axes_[axis].unit;
      const double ahead = start.tangent[start.tangent.size() - 2 + axis];
      if ((ahead < 0 && at - ranges_[axis][0] <= rounding) || (ahead > 0 && ranges_[axis][1] - at <= rounding))
        return true;
    }
    return false;
  }

  void end_at_bound(const OrbitEquations& equations, const Walk& walk, std::size_t axis, double bound, double step) {
    auto zero = walk.zero([&](const CurvePoint& p) { return parameter(p.at, axis) - bound; }, step);
    if (!zero) return record_.fail(point_of(equations, walk.here()), no_step);
    zero->at[zero->at.size() - 2 + axis] = bound / axes_[axis].unit;  // R = 0 less a rounding would be no impact
    const double length = zero->arclength - walk.here().arclength;
    if (violation(equations, zero->at)) return end_in_graze(equations, walk, length);
    special_between(equations, walk, length);
    note_start_between(equations, walk, length);
    const BranchPoint last = point_of(equations, *zero);
    record_.add(last), record_.end(last, "range");
  }

  /// The curve ends where a turning point touches a stop, too, or its own slowest impact vanishes: on a rigid stop a
  /// resonant graze, in which curves of multipliers +1 and -1 meet that of the graze.
  void end_in_graze(const OrbitEquations& equations, const Walk& walk, double step) {
    const auto between = narrowed(equations, walk, step);
    if (!between) return record_.fail(point_of(equations, walk.here()), no_step);
    if (between->violated.kind == Violation::Kind::at_once)
      return end_at(SpecialKind::simultaneous,
                    point_of(equations, point_at_once(equations, walk, *between).value_or(between->last_good)));
    if (between->violated.kind == Violation::Kind::no_rebound)
      return end_at(SpecialKind::rebound_threshold, point_of(equations, point_at_threshold(equations, walk, *between)));
    if (const auto change = change_on_curve(any_equations(), equations, walk, step, *between))
      return end_in_change(equations, walk, between->last_good, *change);
    const std::optional<Touch> touch = touch_of(equations, *between);
    special_between(equations, walk, touch->last_good.arclength - walk.here().arclength);
    if (touch->vanishes && ends_without_contact(equations, touch->last_good, touch->beyond.at, *touch->vanishes))
      return;
    Condition condition = equations.conditions().front();
    const bool of_multiplier = condition.kind == Condition::Kind::multiplier;
    if (touch->appears && of_multiplier) condition.without = touch->event;
    if (touch->appears && !of_multiplier && touch->event <= condition.event) ++condition.event;
    BranchPoint last = point_of(equations, touch->last_good);
    const FollowedScene near = equations.scene_at(touch->beyond.at);
    const bool on_soft_stop = !is_impact(touch->orbit.events[touch->event].kind);
    SpecialKind kind =
        of_multiplier && !touch->appears && !on_soft_stop ? SpecialKind::resonant_graze : SpecialKind::graze;
    auto exact = solved({condition, touch->graze().condition}, near, touch->orbit);
    for (const bool symmetric : {is_symmetric(near), false}) {
      if (exact || on_soft_stop) break;
      // several speeds vanish at once and leave motion that repeats sooner: its resonance tells where
      const Orbit last_left = with_one_slow_impact(touch->orbit);
      const Orbit once = last_left.once_with_graze(slowest_impact(last_left), symmetric);
      exact = solved({{Condition::Kind::graze, 1, slowest_impact(once)}, {Condition::Kind::multiplier, 1}}, near, once);
      kind = SpecialKind::resonant_graze;
    }
    if (!exact) return end_near_graze(equations, touch->last_good, no_graze);
    std::tie(last.scene, last.orbit) = *exact;
    record_.note(kind, last);
    if (touch->appears && kind == SpecialKind::graze) last.orbit = last.orbit.without(touch->event);
    record_.add(last), record_.end(last, std::string(name_of(kind)));
  }

  /// Friction begins to hold the mass somewhere, or no longer does, or an impact begins or vanishes.
  void end_in_change(const OrbitEquations& equations, const Walk& walk, const CurvePoint& last_good,
                     const ChangeOnCurve& change) {
    special_between(equations, walk, change.at.arclength - walk.here().arclength);
    const bool of_multiplier = equations.conditions().front().kind == Condition::Kind::multiplier,
               loses_impact = change.event && is_impact(equations.shape().events[*change.event].kind);
    const SpecialKind kind = of_multiplier && loses_impact ? SpecialKind::resonant_graze : change.kind;
    BranchPoint last = point_of(equations, last_good);  // multipliers have no digits where an impact has no speed
    last.scene = equations.scene_at(change.at.at), last.orbit = point_of(equations, change.at).orbit;
    BranchPoint special = last;
    special.orbit = with_impact_at_graze(special.scene, special.orbit, change.event);
    record_.note(kind, special);
    record_.add(last), record_.end(last, std::string(name_of(kind)));
  }

  /// The point within a step at which a pair of multipliers with the product 1 becomes real.
  [[nodiscard]] std::optional<BranchPoint> strong_resonance(const OrbitEquations& equations, const Walk& walk,
                                                            double step) const {
    if (kind_ != SpecialKind::neimark_sacker) return std::nullopt;
    const auto beyond_real = [&](const CurvePoint& p) {
      return housing_characteristic(equations.scene_at(p.at), equations.orbit_at(p.at)).beyond_real();
    };
    const auto zero = walk.zero(beyond_real, step);
    return zero ? std::optional(point_of(equations, *zero)) : std::nullopt;
  }
  /// The curve ends in a special point of its own.
  void end_at(SpecialKind kind, const BranchPoint& last) {
    record_.note(kind, last);
    record_.add(last), record_.end(last, std::string(name_of(kind)));
  }

  /// Whether the curve ends because a contact with a soft stop, or an interruption of one, vanishes there.
  bool ends_without_contact(const OrbitEquations& equations, const CurvePoint& last_good, const Vector& near,
                            std::size_t contact) {
    const auto exact = solved({equations.conditions().front(), {Condition::Kind::duration, 1, contact}},
                              equations.scene_at(near), equations.orbit_at(near));
    if (!exact) return false;
    BranchPoint last = point_of(equations, last_good);
    last.scene = exact->first, last.orbit = with_graze(exact->second, contact);
    record_.note(SpecialKind::graze, last);
    record_.add(last), record_.end(last, "graze");
    return true;
  }

  /// If several contacts vanish at once, as motion repeats sooner there, the equations lose their digits near the end,
  /// and the proof finds another turning point first: the shortest contact tells it. Else it is a failure. On a curve
  /// of grazes the equations of both have no single solution.
  void end_near_graze(const OrbitEquations& equations, const CurvePoint& last_good, std::string_view failure) {
    const auto contact = shortest_contact(equations.orbit_at(last_good.at));
    if (contact && !equations.grazing() && ends_without_contact(equations, last_good, last_good.at, *contact)) return;
    const BranchPoint last = point_of(equations, last_good);
    if (has_events_at_once(last.orbit)) return end_at(SpecialKind::simultaneous, last);
    constexpr double vanishes = 1e-3;  // rad
    if (const auto slip = vanishing_slip(equations, last_good, vanishes)) return end_at(slip->kind, last);
    if (failure == no_graze) record_.add(last);
    record_.fail(last, has_friction(last.scene.friction) && failure == no_graze ? no_halt_change : failure);
  }

  /// The solution of an orbit's equations with two conditions near a guess; nothing if there is none near.
  [[nodiscard]] std::optional<std::pair<FollowedScene, Orbit>> solved(std::vector<Condition> conditions,
                                                                      const FollowedScene& scene,
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
      if (i != kept && std::abs(orbit.events[i].before) < 1e-2 * speed_unit_) orbit = orbit.without(i);
    return orbit;
  }

  /// The special point of a branch along the first parameter, at the scene's value of the second, within a step.
  void note_start_between(const OrbitEquations& equations, const Walk& walk, double step) {
    const double across = value_of(problem_, *settings_.across);
    const auto zero = walk.zero([&](const CurvePoint& p) { return parameter(p.at, across_axis) - across; }, step);
    if (zero) record_.note(kind_, point_of(equations, *zero));
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
        record_.note(SpecialKind::cusp, point_of(equations, *turned));
      return;
    }
    const bool is_of_two_numbers = !has_loose_mass(problem_.loose);  // as the conditions for resonant ones are
    const std::size_t graze = *equations.grazing();
    const bool has_root = is_impact(with_impact_at_graze(problem_, equations.shape(), graze).events[graze].kind);
    if (!has_root || !is_of_two_numbers) return;
    for (const int periods : {1, 2, 3, 4}) {
      if (periods > 1 && equations.shape().mirrored) break;
      const auto resonant = zero_of([&](const CurvePoint& p) { return resonance(equations, p.at, periods); });
      if (!resonant) continue;
      BranchPoint at = record_.point(equations, *resonant);
      at.orbit = grazing_once_in(at.scene, at.orbit, graze, periods);
      record_.note(SpecialKind::resonant_graze, at);
    }
  }

  StartProblem problem_;
  BranchSettings settings_;
  std::array<std::array<double, 2>, 2> ranges_;  ///< [axis]: low and high
  std::vector<OrbitEquations::Axis> axes_;
  double speed_unit_ = 0.0;
  SpecialKind kind_ = SpecialKind::fold;  ///< of the points of the curve
  Record record_;
};

}  // namespace

Branches follow_curves(const StartProblem& problem, const BranchSettings& settings) {
  return CurveFollower(problem, settings).run();
}

}  // namespace clatter::branches
