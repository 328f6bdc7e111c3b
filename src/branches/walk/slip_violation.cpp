#include "branches/walk/slip_violation.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "branches/equations/links.hpp"
#include "branches/walk/flight_end.hpp"

namespace clatter::branches {
namespace {

constexpr double shortest = 1e-9;         // rad, of a slip
constexpr double about_to_vanish = 1e-6;  // rad, of a contact with a soft stop: rounding decides when its force turns

/// Whether all that an orbit does is to slip from stick to stick, for less than some phase each time.
template <Effects E>
bool slips_for_less(const Flights<double, E>& flights, const Orbit& orbit, double less_than) {
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const Flight<double> flight = detail::flight_of<double>(orbit, i);
    if (flight.leaves != Event::Kind::stick || flight.arrives != Event::Kind::stick) return false;
    if (!(flight.end - flights.start(flight) < less_than)) return false;
  }
  return orbit.size() > 0;
}

/// Whether friction holds a mass where an orbit says so, and lets it go where it says so.
template <Effects E>
std::optional<Violation> at_halt(const Flights<double, E>& flights, const Orbit& orbit, std::size_t i, bool grazes) {
  using enum Violation::Kind;
  const OrbitEvent& halt = orbit.events[i];
  const Standing<double> at = standing_at(halt);
  if (!grazes && flights.soft_stop_around(at.place) != at.held_by) return Violation{pulls, i, {}};
  const auto holds = [&](Side side) { return flights.left_to_level(at, side) >= 0; };
  const auto release = [&](Side side) { return flights.releases().hold(at, side); };
  const Side before = orbit.heading_before(i), other = opposite(halt.side);
  if (halt.kind == Event::Kind::reversal)
    return holds(halt.side) ? std::optional(Violation{sticks, i, {}}) : std::nullopt;
  if (!holds(halt.side) || !holds(other)) return Violation{slips, i, {}};
  if (release(halt.side) == std::numeric_limits<double>::infinity()) return Violation{stays, i, {}};
  if (!(sign_of(before) * flights.acceleration(at, before) <= 0)) return Violation{runs_on, i, {}};
  return release(other) < release(halt.side) ? std::optional(Violation{slips, i, {}}) : std::nullopt;
}

/// The margins of a flight that goes one way: the gap to the stop ahead, the velocity, and in contact with a soft stop
/// the force of that, or the pull that there would be beyond the position of one with a damper.
template <class A>
std::array<Margin, 3> margins_of(const SceneNumbers<double>& p, const A& arc, const Flight<double>& flight) {
  const double sign = sign_of(flight.heading());
  const Margin none{1.0, 0.0, 0.0}, velocity{0.0, 0.0, sign};
  const Side pressed = flight.pressed();
  const bool leaves = flight.leaves == Event::Kind::separation && p.soft_stop(flight.from).damping != 0;
  Margin gap{sign * (p.position(flight.heading()) - arc.anchor()), -sign, 0.0}, force = none;
  if (pressed != Side::none) gap = none;
  if (pressed != Side::none || leaves) {
    const motion::SoftStop<double> stop = p.soft_stop(leaves ? flight.from : pressed);
    const double into = leaves ? -stop.into(1.0) : stop.into(1.0);
    force = {into * (arc.anchor() - stop.position), into, into * stop.relaxation()};
  }
  return {gap, velocity, force};
}
/// The margin that falls to 0 at an event.
std::size_t margin_at(Event::Kind kind) {
  return halts(kind) ? 1 : kind == Event::Kind::separation || kind == Event::Kind::renewal ? 2 : 0;
}

/// Whether a flight meets the stop ahead, or halts, or the force of a soft stop falls to 0 or rises from it, at its end
/// and not before. One that ends in a halt on the position of a stop, a graze, comes to that all the way: it does if
/// its velocity keeps its sign.
template <Effects E>
std::optional<Violation> in_flight(const Flights<double, E>& flights, const Orbit& orbit, std::size_t i,
                                   std::optional<std::size_t> grazing = {}) {
  const Flight<double> flight = detail::flight_of<double>(orbit, i);
  const SceneNumbers<double>& p = flights.parameters();
  const Side ahead = flight.heading();
  const double start = flights.start(flight), nu = p.oscillator.frequency, length = (flight.end - start) / nu;
  if (!(length > 0))
    return Violation{flight.may_vanish(p) ? Violation::Kind::ends_early : Violation::Kind::slips, i, {}};
  if (flight.arrives == Event::Kind::stick && !is_of_soft_stop(flight.leaves) && length * nu < shortest)
    return Violation{Violation::Kind::vanishes, i, {}};
  return flights.with_arc(flight, [&](const auto& arc) -> std::optional<Violation> {
    std::array<Margin, 3> margins = margins_of(p, arc, flight);
    const bool grazes = (i + 1) % orbit.size() == grazing && halts(flight.arrives);
    if (grazes) margins[0] = {1.0, 0.0, 0.0};
    if (grazes && flight.pressed() != Side::none) margins[2] = {1.0, 0.0, 0.0};
    const auto crossing = motion::first_crossing(arc, margins, length);
    const motion::Motion<double>& m = crossing.motion;
    if (crossing.resolved && crossing.margin == margins.size()) return std::nullopt;
    const bool meets = crossing.margin == 0, stands = !meets && crossing.margin != 2;
    if (crossing.resolved && (grazes || crossing.margin == margin_at(flight.arrives)) &&
        is_at_end(crossing.elapsed, length, stands ? m.v : m.x, stands ? m.a : m.v, nu))
      return std::nullopt;
    if (meets) return Violation{Violation::Kind::passes_through, i, {ahead, flight.end, 0.0}};
    const double turn = turning_time(arc, margins.at(stands ? 1 : 2), crossing.elapsed);
    const double v = arc.at(turn).v, place = static_cast<double>(arc.at(turn).x) - p.middle();
    const Side pressed = flight.pressed();
    if (!stands && flight.may_vanish(p) && length * nu < about_to_vanish)
      return Violation{Violation::Kind::ends_early, i, {}};
    if (!stands) {
      const bool contact = pressed != Side::none;
      return Violation{
          Violation::Kind::passes_through,
          i,
          {opposite(ahead), start + nu * turn, v, contact ? Event::Kind::renewal : Event::Kind::separation}};
    }
    // beside a graze the velocity and the way to the stop fall to 0 at once: the impact has no speed
    if (!halts(flight.arrives) && turn > length) return Violation{Violation::Kind::pulls, (i + 1) % orbit.size(), {}};
    return Violation{
        Violation::Kind::halts, i, {ahead, start + nu * turn, 0.0, Event::Kind::stick, 0.0, place, {}, pressed}};
  });
}

/// Whether friction is nearly up to the force, and all slips are short: of the way to where it is, their lengths are
/// three times the root of its double.
template <Effects E>
bool ceases(const Flights<double, E>& flights, const Orbit& orbit) {
  constexpr double short_slip = 1e-2, near = 1e-5;  // rad; of the force
  const double force = std::abs(flights.constants().f);
  return std::abs(force - flights.parameters().friction.static_level) <= near * force &&
         slips_for_less(flights, orbit, short_slip);
}

}  // namespace

std::vector<Violation> slip_violations(const FollowedScene& scene, const Orbit& orbit,
                                       std::optional<std::size_t> grazing) {
  std::vector<Violation> found;
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const auto add = [&](const std::optional<Violation>& violation) {
    if (violation) found.push_back(told_apart(p, orbit, *violation));
  };
  with_arcs(scene, [&]<Effects E>() {
    const Flights<double, E> flights{p};
    if (ceases(flights, orbit)) found.push_back({Violation::Kind::ceases, 0, {}});
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const OrbitEvent& event = orbit.events[i];
      if (halts(event.kind)) add(at_halt(flights, orbit, i, i == grazing));
      if (i == grazing || halts(event.kind)) continue;
      if (!(sign_of(event.side) * (event.is_contact() ? event.before : -event.before) > 0))
        add(Violation{Violation::Kind::pulls, i, {}});
    }
    for (std::size_t i = 0; i < orbit.size(); ++i) add(in_flight(flights, orbit, i, grazing));
  });
  return found;
}

bool hardly_slips(const FollowedScene& scene, const Orbit& orbit, double less_than) {
  return with_arcs(scene, [&]<Effects E>() {
    return slips_for_less(Flights<double, E>{numbers_of<double>(scene)}, orbit, less_than);
  });
}

Orbit with_halts(const FollowedScene& scene, const Orbit& orbit) {
  Orbit halting = orbit;
  with_arcs(scene, [&]<Effects E>() {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    for (std::size_t i = orbit.size(); i-- > 0;)
      if (const auto found = in_flight(flights, orbit, i); found && found->kind == Violation::Kind::halts)
        halting = halting.with(found->turning, i + 1);
  });
  return halting;
}

}  // namespace clatter::branches
