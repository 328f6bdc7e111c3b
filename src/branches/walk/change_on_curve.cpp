#include "branches/walk/change_on_curve.hpp"

#include <cmath>
#include <limits>

#include "branches/equations/links.hpp"
#include "branches/walk/flight_end.hpp"
#include "branches/walk/slip_violation.hpp"

namespace clatter::branches {
namespace {

/// The halt of a walked motion that the condition of a change is on, in an orbit which may begin with another event, or
/// have lost some.
std::optional<std::size_t> halt_of(const Orbit& walked, const HaltChange& change) {
  constexpr double same = 1e-2;  // rad
  const double phase = change.orbit.events[change.condition.event].phase;
  std::optional<std::size_t> nearest;
  double least = same;
  for (std::size_t i = 0; i < walked.size(); ++i) {
    const double off = std::abs(std::remainder(walked.events[i].phase - phase, walked.advance()));
    if (off < least) least = off, nearest = i;
  }
  return nearest && halts(walked.events[*nearest].kind) ? nearest : std::nullopt;
}

/// The least velocity, the way that the mass goes, on flight i.
double least_velocity(const FollowedScene& scene, const Orbit& orbit, std::size_t i, double near_phase) {
  return with_arcs(scene, [&]<Effects E>() {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    const Flight<double> flight = detail::flight_of<double>(orbit, i);
    const double sign = sign_of(flight.heading());
    return flights.with_arc(flight, [&](const auto& arc) {
      const double after = (near_phase - flights.start(flight)) / flights.parameters().oscillator.frequency;
      return sign * arc.at(turning_time(arc, Margin{0.0, 0.0, sign}, after)).v;
    });
  });
}

}  // namespace

std::optional<ChangeOnCurve> change_on_curve(const Equations& builder, const OrbitEquations& walked, const Walk& walk,
                                             double step, const Narrowed& between) {
  const FollowedScene beyond = walked.scene_at(between.beyond.at);
  if (!has_friction(beyond.friction)) return std::nullopt;
  const Orbit orbit = walked.orbit_at(between.beyond.at);
  const std::vector<Violation> violations = slip_violations(beyond, orbit, walked.grazing());
  const std::vector<HaltChange> changes = halt_changes(walked, between, violations);
  std::optional<ChangeOnCurve> nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](SpecialKind kind, std::optional<std::size_t> event, const TestFunction& test) {
    const auto zero = walk.zero(test, step);
    const double off = zero ? std::abs(zero->arclength - between.last_good.arclength) : least;
    if (off < least) least = off, nearest = ChangeOnCurve{kind, *zero, event};
  };
  const auto consider_condition = [&](SpecialKind kind, std::optional<std::size_t> event, const Condition& condition) {
    const OrbitEquations there = builder(walked.shape(), {condition});
    consider(kind, event, [&](const CurvePoint& point) {
      const auto linearised = there.at(point.at);
      return linearised ? linearised->residual.back() : std::numeric_limits<double>::quiet_NaN();
    });
  };
  for (const HaltChange& change : changes)
    if (const auto halt = halt_of(orbit, change); halt && change.kind != SpecialKind::motion_ceases) {
      Condition condition = change.condition;
      condition.event = *halt;
      const bool on_stop = condition.kind == Condition::Kind::on_stop;
      if (!(on_stop && halt == walked.grazing()))
        consider_condition(change.kind, on_stop ? halt : std::nullopt, condition);
    }
  for (const Violation& found : violations) {
    const std::size_t next = (found.event + 1) % orbit.size();
    const bool meets = found.kind == Violation::Kind::passes_through && is_impact(found.turning.kind);
    if (found.kind == Violation::Kind::halts)
      consider(SpecialKind::grazing_sliding, std::nullopt, [&](const CurvePoint& point) {
        return least_velocity(walked.scene_at(point.at), walked.orbit_at(point.at), found.event, found.turning.phase);
      });
    if (meets && halts(orbit.events[next].kind))
      consider_condition(
          SpecialKind::graze, next,
          {.kind = Condition::Kind::on_stop, .event = next, .without = {}, .side = orbit.heading_before(next)});
    if (found.kind == Violation::Kind::pulls && is_impact(orbit.events[found.event].kind))
      consider_condition(SpecialKind::graze, found.event, {Condition::Kind::graze, 1, found.event});
  }
  if (nearest) return nearest;
  constexpr double vanishes = 1e-3;  // rad
  // the slip before it vanishes with the root of the way to the end, so that no step leads beyond
  if (const auto slip = vanishing_slip(walked, between.last_good, vanishes))
    return ChangeOnCurve{slip->kind, between.last_good};
  return std::nullopt;
}

}  // namespace clatter::branches
