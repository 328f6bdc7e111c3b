#include "branches/simultaneous_end.hpp"

#include <algorithm>
#include <utility>

#include "branches/equations/flight.hpp"

namespace clatter::branches {
namespace {

/// The first of two events at once, one of each mass, before which no other one is as near.
std::optional<std::size_t> first_at_once(const Orbit& orbit) {
  constexpr double at_once = 1e-7;  // rad: as near as steps come to it
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent one = orbit.event(i), other = orbit.event(i + 1);
    if (one.is_of_wall() != other.is_of_wall() && other.phase - one.phase < at_once) return i;
  }
  return std::nullopt;
}

/// The orbit with the two events in the other order; nothing if one is an impact, which changes the other one.
std::optional<Orbit> exchanged(const FollowedScene& scene, const Orbit& given, std::size_t first) {
  Orbit orbit = given.from_event(first);
  if (orbit.size() < 2) return std::nullopt;
  OrbitEvent &one = orbit.events[0], &two = orbit.events[1];
  const bool strikes_first = one.is_of_wall();
  const OrbitEvent& strike = strikes_first ? one : two;
  OrbitEvent& of_stop = strikes_first ? two : one;
  if (of_stop.kind == Event::Kind::impact) return std::nullopt;
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const motion::WallRule<double> rule(p.loose);
  const double wall = (strike.side == Side::upper ? p.loose.upper : p.loose.lower) - p.middle_of_walls();
  if (strikes_first) {
    of_stop.before = strike.other.before, of_stop.other = {wall, strike.before};
  } else {
    of_stop.before = rule.main_after(strike.other.before, strike.before);
    of_stop.other = {wall, rule.law(strike.side).after(strike.before)};
  }
  std::swap(one.phase, two.phase), std::swap(one, two);
  return orbit;
}

}  // namespace

bool has_events_at_once(const Orbit& orbit) { return first_at_once(orbit).has_value(); }

std::optional<CurvePoint> point_at_once(const OrbitEquations& equations, const Walk& walk, const Narrowed& between) {
  const Violation& found = between.violated;
  if (!is_impact(found.turning.kind)) return std::nullopt;
  const auto beyond = [&](const CurvePoint& point) {  // of the wall or the stop, at the event of the other mass
    const SceneNumbers<double> p = numbers_of<double>(equations.scene_at(point.at));
    const double place = equations.orbit_at(point.at).event(found.event + 1).other.place,
                 sign = sign_of(found.turning.side);
    if (!found.turning.is_of_wall()) return sign * (p.middle() + place - p.position(found.turning.side));
    return sign * (p.middle_of_walls() + place - (sign > 0 ? p.loose.upper : p.loose.lower));
  };
  const double begin = walk.here().arclength;
  return walk.zero(beyond, between.beyond.arclength - begin, between.last_good.arclength - begin);
}

void end_at_once(const Equations& builder, const BranchPoint& last, double tolerance, Record& record,
                 std::deque<Waiting>& waiting, std::int64_t generation) {
  record.add(last);
  const auto [special, is_new] = record.note(SpecialKind::simultaneous, last);
  record.end(last, std::string(name_of(SpecialKind::simultaneous)));
  if (!is_new) return no_longer_waits(waiting, special, last.orbit);  // this is the branch that waits there
  const auto first = first_at_once(last.orbit);
  const auto other = first ? exchanged(last.scene, last.orbit, *first) : std::nullopt;
  if (!other) return;
  const OrbitEquations equations = builder(*other, {});
  const Waiting beyond{last.scene, *other, {}, special, generation};
  if (first_step(equations, {equations.unknowns_of(last.scene, *other), {}, 0.0}, beyond, tolerance))
    waiting.push_back(beyond);
}

}  // namespace clatter::branches
