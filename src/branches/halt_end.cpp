#include "branches/halt_end.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "branches/walk/slip_violation.hpp"

namespace clatter::branches {
namespace {

/// The grazes that violations may be: an impact without speed, or a reversal on a rigid stop; or a contact with a soft
/// stop, or the interruption of one, that appears or vanishes.
std::vector<Violation> grazes_of(const FollowedScene& scene, const Orbit& orbit,
                                 const std::vector<Violation>& violations) {
  std::vector<Violation> grazes;
  for (const Violation& violation : violations) {
    const Violation::Kind kind = violation.kind;
    const OrbitEvent next = orbit.event(violation.event + 1);
    const bool reaches = kind == Violation::Kind::passes_through &&
                         (!is_impact(violation.turning.kind) ||
                          (next.kind == Event::Kind::reversal && !is_soft(scene.stops, violation.turning.side)));
    const bool pulls = kind == Violation::Kind::pulls && is_impact(orbit.events[violation.event].kind);
    if (reaches || pulls || kind == Violation::Kind::ends_early) grazes.push_back(violation);
  }
  return grazes;
}

/// How far a value lies outside of an interval that two others bound in any order; nothing less than rounding.
double outside(double value, double one, double other) {
  constexpr double rounding = 1e-9;
  const auto [low, high] = std::minmax(one, other);
  const double off = std::max(low - value, value - high);
  return off <= rounding ? 0.0 : off;
}

/// Whether a stick on a stop comes after a chatter there: several impacts, ever slower.
bool ends_chatter(const Orbit& orbit, std::size_t stick) {
  constexpr int several = 4;
  const Orbit last = orbit.from_event((stick + 1) % orbit.size());
  double slower = 0.0;
  int impacts = 0;
  for (std::size_t i = last.size() - 1; i-- > 0;) {
    const OrbitEvent& event = last.events[i];
    if (halts(event.kind) && event.side == orbit.heading_before(stick)) continue;
    if (halts(event.kind) || event.side != orbit.heading_before(stick) || !(std::abs(event.before) > slower)) break;
    slower = std::abs(event.before), ++impacts;
  }
  return impacts >= several;
}

/// The stop on whose position a mass halts.
Side stop_at(const FollowedScene& scene, const OrbitEvent& halt) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const auto off = [&](Side side) { return std::abs(p.middle() + halt.place - p.position(side)); };
  return off(Side::lower) < off(Side::upper) ? Side::lower : Side::upper;
}

}  // namespace

std::optional<FrictionEnd> nearest_end(const Equations& builder, const OrbitEquations& walked, const Narrowed& between,
                                       bool symmetric_scenes, double within, double tolerance) {
  const FollowedScene beyond = walked.scene_at(between.beyond.at);
  if (!has_friction(beyond.friction)) return std::nullopt;
  const std::vector<Violation> violations = slip_violations(beyond, walked.orbit_at(between.beyond.at), {});
  const OrbitEquations::Axis& axis = walked.axes().front();
  // where derivatives have no digits, bisection ends while the bracket is still wide
  within = std::max(within, std::abs(between.beyond.at.back() - between.last_good.at.back()));
  std::optional<FrictionEnd> nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::optional<ExactGraze>& exact, auto&&... what) {
    if (!exact) return;
    const double off = outside(value_of(exact->scene, axis.parameter) / axis.unit, between.last_good.at.back(),
                               between.beyond.at.back());
    if (off < least) least = off, nearest = FrictionEnd{*exact, what...};
  };
  for (const HaltChange& change : halt_changes(walked, between, violations))
    consider(exact_change(builder, beyond, change, symmetric_scenes, within, tolerance), change);
  for (const Violation& graze : grazes_of(beyond, walked.shape(), violations)) {
    const Touch touch = touch_of(walked, {between.last_good, between.beyond, graze});
    consider(exact_graze(builder, beyond, touch.graze(), 0.0, false, within, tolerance), std::nullopt, graze);
  }
  return nearest;
}

void end_in_change(const FrictionEnd& end, const BranchPoint& last_good, Record& record, std::deque<Waiting>& waiting,
                   std::int64_t generation) {
  const ExactGraze& exact = end.exact;
  const HaltChange& change = *end.change;
  const auto with_form = [&](HaltForm form) { return formed(exact.scene, exact.orbit, exact.event, form); };
  BranchPoint at = last_good;
  at.scene = exact.scene, at.orbit = with_form(change.before.value_or(HaltForm::stick));
  const BranchPoint& last = change.before && !exact.joins ? at : last_good;
  record.add(last);
  // beyond the limit the chatter ends in a rest on the stop, which isn't followed under friction
  if (change.opens == Opening::Kind::rebound && ends_chatter(exact.orbit, exact.event) &&
      record.is_of_cascade(last, 1e-4))
    return record.end(last, "chatter limit");
  Condition condition = change.condition;  // of the motion that repeats sooner, if it does
  condition.event = exact.event;
  if (condition.kind == Condition::Kind::on_stop)
    condition.side = stop_at(exact.scene, exact.orbit.events[exact.event]);
  const auto [special, is_new] = record.note(change.kind, at, condition);
  record.end(last, std::string(name_of(change.kind)));
  const bool jumps = change.opens == Opening::Kind::rebound && slips_on_from_stop(exact.scene, at.orbit, exact.event);
  const bool passes = change.opens && Opening{*change.opens}.is_of_soft_stop();
  if (!is_new || jumps || !(change.beyond || change.opens))
    return no_longer_waits(waiting, special, passes ? last_good.orbit : last.orbit);
  waiting.push_back({exact.scene, with_form(change.beyond.value_or(HaltForm::stick)), {}, special, generation});
  if (change.opens) waiting.back().opens = {*change.opens, exact.event};
  if (exact.joins && change.before && !passes) waiting.push_back({exact.scene, at.orbit, {}, special, generation});
}

}  // namespace clatter::branches
