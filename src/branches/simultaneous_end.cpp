#include "branches/simultaneous_end.hpp"

#include <cmath>
#include <utility>
#include <vector>

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

/// The main mass and z' after a strike.
std::pair<double, double> after(const SceneNumbers<double>& p, const OrbitEvent& strike) {
  const motion::WallRule<double> rule(p.loose);
  return {rule.main_after(strike.other.before, strike.before), rule.law(strike.side).after(strike.before)};
}
double wall_of(const SceneNumbers<double>& p, const OrbitEvent& strike) {
  return (strike.side == Side::upper ? p.loose.upper : p.loose.lower) - p.middle_of_walls();
}

/// Orbits as they may be beyond two events at once: these in the other order, or as one if the strike brings a contact
/// in place of a touch. None if one is an impact, which changes the other one.
std::vector<Orbit> beyond_exchange(const SceneNumbers<double>& p, const Orbit& given, std::size_t first) {
  Orbit orbit = given.from_event(first);
  OrbitEvent &one = orbit.events[0], &two = orbit.events[1];
  const bool strikes_first = one.is_of_wall();
  const OrbitEvent strike = strikes_first ? one : two;
  OrbitEvent& of_stop = strikes_first ? two : one;
  if (of_stop.kind == Event::Kind::impact) return {};
  std::vector<Orbit> found;
  if (strikes_first && of_stop.kind == Event::Kind::touch) {
    found.push_back(orbit.without(1));
    found.back().events[0].contact = of_stop.side;
  }
  const auto [v, w] = after(p, strike);
  of_stop.before = strikes_first ? strike.other.before : v;
  of_stop.other = {wall_of(p, strike), strikes_first ? strike.before : w};
  std::swap(one.phase, two.phase), std::swap(one, two);
  found.push_back(orbit);
  return found;
}
/// As it may be beyond a strike that brings a contact with a stop, once it is just at that: a touch follows it.
std::vector<Orbit> beyond_contact(const SceneNumbers<double>& p, Orbit orbit) {
  constexpr double at_once = 1e-5, soon = 1e-6;  // rad, over rounding
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    OrbitEvent& strike = orbit.events[i];
    if (!strike.contact || *strike.contact == Side::none) continue;
    const Side side = *strike.contact;
    if (std::abs(p.middle() + strike.other.place - p.position(side)) > at_once) continue;
    const auto [v, w] = after(p, strike);
    OrbitEvent touch{side, strike.phase + soon, v, Event::Kind::touch};
    touch.other = {wall_of(p, strike), w};
    strike.contact.reset();
    return {orbit.with(touch, i + 1)};
  }
  return {};
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

void end_at_once(const Equations& builder, const BranchPoint& last, bool symmetric_scene, double tolerance,
                 Record& record, std::deque<Waiting>& waiting, std::int64_t generation) {
  record.add(last);
  const auto [special, is_new] = record.note(SpecialKind::simultaneous, last);
  record.end(last, std::string(name_of(SpecialKind::simultaneous)));
  if (!is_new) return no_longer_waits(waiting, special, last.orbit);  // this is the branch that waits there
  constexpr double goes_on = 1e-5;  // over that, the exchange changes more than the order
  const SceneNumbers<double> p = numbers_of<double>(last.scene);
  const auto first = first_at_once(last.orbit);
  for (const Orbit& each : first ? beyond_exchange(p, last.orbit, *first) : beyond_contact(p, last.orbit)) {
    const Orbit other = each.half_if_same(1e-6, symmetric_scene);  // of which only one repetition was exchanged before
    const OrbitEquations equations = builder(other, {});
    const Vector here = equations.unknowns_of(last.scene, other);
    const auto exchanged = equations.at(here);
    if (!exchanged || !(largest(exchanged->residual) <= goes_on * equations.speed_unit())) continue;
    const Waiting beyond{last.scene, other, {}, special, generation};
    if (first_step(equations, {here, {}, 0.0}, beyond, tolerance)) return waiting.push_back(beyond);
  }
}

}  // namespace clatter::branches
