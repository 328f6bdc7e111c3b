#include "branches/walk/violation.hpp"

#include <algorithm>
#include <cmath>

#include "branches/equations/housing_flight.hpp"
#include "branches/equations/links.hpp"
#include "branches/walk/flight_end.hpp"
#include "branches/walk/rebound_threshold.hpp"
#include "branches/walk/slip_violation.hpp"
#include "motion/contact.hpp"

namespace clatter::branches {

Violation told_apart(const SceneNumbers<double>& p, const Orbit& orbit, const Violation& found) {
  constexpr double about = 1e-6;  // rad: the force turns at about its square
  const auto vanishes = [&](std::size_t i) {
    const Flight<double> flight = detail::flight_of<double>(orbit, i);
    return flight.may_vanish(p) && flight.end - flight.begin < about;
  };
  if (found.kind == Violation::Kind::pulls) {
    // a damper lets go of the mass once it stands, but for rounding, if it has hardly touched it
    const bool separates = orbit.events[found.event].kind == Event::Kind::separation;
    const std::size_t i = separates ? (found.event + orbit.size() - 1) % orbit.size() : found.event;
    return vanishes(i) ? Violation{Violation::Kind::ends_early, i, {}} : found;
  }
  if (is_impact(found.turning.kind)) return found;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const Flight<double> flight = detail::flight_of<double>(orbit, i);
    const double distance = std::remainder(found.turning.phase - flight.begin, orbit.advance());
    if (vanishes(i) && std::abs(distance) < 2 * about) return {Violation::Kind::ends_early, i, {}};
  }
  return found;
}

namespace {

/// A flight that is looked at: the event that it begins with, and its end.
struct Path {
  std::size_t number, next;
  double begin;  ///< forcing phase, rad
  double length;
  Side to;  ///< none: it meets no stop
  Event::Kind arrives = Event::Kind::impact;
  bool ends_in_graze = false;
};

template <Effects E>
std::optional<Violation> passes_through(const motion::Arc<double, E>& arc, const Path& path, const Margin& margin,
                                        double from, Side side, Event::Kind turns) {
  const double turn = turning_time(arc, margin, from);
  const double v = turns == Event::Kind::impact ? 0.0 : arc.at(turn).v;
  return Violation{
      Violation::Kind::passes_through, path.number, {side, path.begin + arc.constants().nu * turn, v, turns}};
}

template <Effects E>
std::optional<Violation> cut_short(const SceneNumbers<double>& p, const motion::Arc<double, E>& arc, const Path& path) {
  const Stops stops{.lower = p.stops.lower, .upper = p.stops.upper};
  const motion::Crossing<double> contact = motion::next_contact(arc, stops, path.length);
  if (contact.side == Side::none) return std::nullopt;
  const motion::Motion<double> m = contact.motion;
  if (contact.side == path.to && is_at_end(contact.elapsed, path.length, m.x, m.v, arc.constants().nu))
    return std::nullopt;
  const Event::Kind turns = is_soft(p.stops, contact.side) ? Event::Kind::separation : Event::Kind::impact;
  const Margin gap{0.0, -static_cast<double>(sign_of(contact.side)), 0.0};
  std::optional<Violation> found = passes_through(arc, path, gap, contact.elapsed, contact.side, turns);
  found->turning.before = 0.0;
  return found;
}

/// The force of the soft stop that a mass is in contact with stays positive up to the end of the contact.
template <Effects E>
std::optional<Violation> separates(const motion::SoftStop<double>& stop, const motion::Arc<double, E>& arc,
                                   const Path& path) {
  const double into = stop.into(1.0);
  const Margin force{0.0, into, into * stop.relaxation()};
  const auto crossing = motion::first_crossing(arc, std::array{force}, path.length);
  if (crossing.resolved && crossing.margin != 0) return std::nullopt;
  const motion::Motion<double>& m = crossing.motion;
  if (path.to == stop.side && path.arrives != Event::Kind::impact && crossing.resolved &&
      is_at_end(crossing.elapsed, path.length, m.offset, force.slope(m), arc.constants().nu))
    return std::nullopt;
  return passes_through(arc, path, force, crossing.elapsed, stop.side, Event::Kind::renewal);
}

/// After a separation beyond the position of a soft stop the mass comes back to that position, or to the stop.
template <Effects E>
std::optional<Violation> free_within(const SceneNumbers<double>& p, const motion::SoftStop<double>& stop,
                                     const motion::Arc<double, E>& arc, const Path& path) {
  const double into = stop.into(1.0), nu = arc.constants().nu;
  const Margin depth{0.0, into, 0.0}, pull{0.0, -into, -into * stop.relaxation()};
  const auto crossing = motion::first_crossing(arc, std::array{depth, pull}, path.length);
  const motion::Motion<double>& m = crossing.motion;
  const bool renews = path.arrives == Event::Kind::renewal;
  if (crossing.resolved && crossing.margin == 0 && !renews) {
    Path rest = path;
    rest.begin += nu * crossing.elapsed, rest.length -= crossing.elapsed;
    motion::Motion<double> leaving = m;
    leaving.offset = 0, leaving.x = stop.position;
    if (!(rest.length > 0)) return std::nullopt;
    return cut_short(p, motion::Arc(arc.constants(), leaving, stop.position), rest);
  }
  const bool is_struck = path.arrives == Event::Kind::strike && crossing.margin == 2;
  if ((renews || path.ends_in_graze || is_struck) && crossing.resolved &&
      (crossing.margin == 2 ||
       (crossing.margin == 1 && is_at_end(crossing.elapsed, path.length, m.offset, pull.slope(m), nu))))
    return std::nullopt;
  // where the mass just comes back to that position first, a renewal turns into a touch of the stop from outside
  const bool is_late = (path.length - crossing.elapsed) * arc.constants().rate < 1e-2;
  if (presses(path.arrives) && path.to == stop.side && is_late) return Violation{Violation::Kind::pulls, path.next, {}};
  return passes_through(arc, path, pull, crossing.elapsed, stop.side, Event::Kind::separation);
}

/// Whether the velocity of an event has the right sign.
bool points_right(const OrbitEvent& event) {
  const double into = sign_of(event.side) * event.before;
  return event.is_contact() ? into > 0 : into < 0;
}

/// Motion without events.
template <Effects E>
std::optional<Violation> response_violation(const Flights<double, E>& flights, const Orbit& orbit) {
  const SceneNumbers<double>& p = flights.parameters();
  return flights.with_response(orbit.pressed, [&](const auto& arc) -> std::optional<Violation> {
    const Path path{0, 0, 0.0, orbit.advance() / p.oscillator.frequency, Side::none};
    if (orbit.pressed != Side::none) return separates(p.soft_stop(orbit.pressed), arc, path);
    for (const Side side : {Side::lower, Side::upper})  // begins beyond the stop
      if (const double sign = sign_of(side); sign * (arc.start().x - p.position(side)) > 0) {
        const double turn = crest_of(flights.response(Side::none), sign) - flights.lead();
        const Event::Kind turns = is_soft(p.stops, side) ? Event::Kind::separation : Event::Kind::impact;
        return Violation{Violation::Kind::passes_through, 0, {side, turn, 0.0, turns}};
      }
    return cut_short(p, arc, path);
  });
}

/// A flight between two events of an orbit, and how the main mass moves on it.
struct Leg {
  Flight<double> flight;
  Path path;
  bool is_pressed;    ///< it is in contact with a soft stop
  bool leaves_graze;  ///< it begins with one from outside
  bool is_beside_graze;
};
/// `beside`: the stop from which it counts after a strike.
Leg leg_of(const Orbit& orbit, std::size_t i, double nu, std::optional<std::size_t> grazing, Side beside = Side::none) {
  Leg leg{detail::flight_of<double>(orbit, i), {}, orbit.pressed_after(i) != Side::none, false, false};
  Flight<double>& flight = leg.flight;
  const bool is_struck = flight.leaves == Event::Kind::strike;
  if (is_struck) flight.from = beside;
  if (flight.arrives == Event::Kind::strike) flight.to = Side::none;
  const bool without_speed = flight.leaves == Event::Kind::impact || std::abs(flight.coordinate) <= 1e-9;
  leg.is_beside_graze = i == grazing && !is_struck;
  leg.leaves_graze = leg.is_beside_graze && !leg.is_pressed && without_speed;
  if (leg.leaves_graze) flight.coordinate = 0;
  leg.path = {i,         (i + 1) % orbit.size(), flight.begin, (flight.end - flight.begin) / nu,
              flight.to, flight.arrives,         false};
  leg.path.ends_in_graze = leg.path.next == grazing && flight.arrives == Event::Kind::separation && !leg.is_pressed;
  return leg;
}

/// The main mass meets no stop before the end of a flight, and a soft stop's force has its sign.
template <Effects E>
std::optional<Violation> leg_violation(const SceneNumbers<double>& p, const motion::Arc<double, E>& arc,
                                       const Leg& leg) {
  // next to its double zero in a graze, the sign of a soft stop's force is that of rounding
  constexpr double clear_of_rounding = 1e-6;
  const Side from = leg.flight.from;
  if (leg.flight.leaves == Event::Kind::impact || leg.leaves_graze || from == Side::none)
    return cut_short(p, arc, leg.path);
  const motion::SoftStop<double> stop = p.soft_stop(from);
  const auto flown = [&](const auto& on, const Path& path) {
    if (leg.is_pressed) return separates(stop, on, path);
    return stop.damping == 0 ? cut_short(p, on, path) : free_within(p, stop, on, path);
  };
  if (!leg.is_beside_graze) return flown(arc, leg.path);
  Path path = leg.path;
  const double clear = std::min(clear_of_rounding / arc.constants().rate, path.length);
  path.begin += p.oscillator.frequency * clear, path.length -= clear;
  return flown(motion::Arc(arc.constants(), arc.at(clear), stop.position), path);
}

/// The loose mass meets no wall before the end of a flight, and the main mass flies as it would alone.
template <Effects E>
std::optional<Violation> leg_violation(const SceneNumbers<double>& p, const motion::RelativeArc<double, E>& arc,
                                       const Leg& leg, Side wall) {
  const Stops walls{.lower = p.loose.lower, .upper = p.loose.upper};
  const double nu = arc.constants().nu, length = leg.path.length;
  const auto beyond = [&](Violation found) {
    const double turn = (found.turning.phase - leg.path.begin) / nu;
    if (turn > length) found.kind = Violation::Kind::at_once;
    const motion::Motion<double> m = arc.at(turn), main = arc.main_at(m);
    found.turning.other = found.turning.is_of_wall() ? OrbitEvent::Other{main.x - p.middle(), main.v}
                                                     : OrbitEvent::Other{m.x - p.middle_of_walls(), m.v};
    return found;
  };
  const motion::Crossing<double> contact = motion::next_contact(arc, walls, length);
  const bool is_end =
      contact.side == wall && is_at_end(contact.elapsed, length, contact.motion.x, contact.motion.v, nu);
  if (contact.side != Side::none && !is_end) {
    const Margin gap{0.0, -static_cast<double>(sign_of(contact.side)), 0.0};
    const double turn = leg.path.begin + nu * turning_time(arc, gap, contact.elapsed);
    return beyond({Violation::Kind::passes_through, leg.path.number, {contact.side, turn, 0.0, Event::Kind::strike}});
  }
  if (leg.flight.leaves == Event::Kind::strike && leg.flight.from != Side::none) {
    // a strike leaves a soft stop's force its sign, or is one that changes the contact
    const motion::Motion<double>& m = arc.main().start();
    const motion::SoftStop<double> stop = p.soft_stop(leg.flight.from);
    const double depth = stop.into(m.offset);
    if ((depth > 0 && stop.force(depth, stop.into(m.v)) > 0) != leg.is_pressed)
      return Violation{
          Violation::Kind::at_once, leg.path.number, {leg.flight.from, leg.path.begin, 0.0, Event::Kind::separation}};
  }
  const auto found = leg_violation(p, arc.main(), leg);
  return found && found->kind == Violation::Kind::passes_through ? std::optional(beyond(*found)) : found;
}

/// The first flight of an orbit that is none: `on_leg(i)` looks at one.
template <class OnLeg>
std::optional<Violation> first_of_legs(const SceneNumbers<double>& p, const Orbit& orbit,
                                       std::optional<std::size_t> grazing, const OnLeg& on_leg) {
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const std::optional<Violation> found = on_leg(i);
    if (found && !(found->kind == Violation::Kind::pulls && found->event == grazing))
      return told_apart(p, orbit, *found);
  }
  return std::nullopt;
}

std::optional<Violation> violation_of_one(const FollowedScene& scene, const Orbit& orbit,
                                          std::optional<std::size_t> grazing) {
  return with_arcs(scene, [&]<Effects E>() -> std::optional<Violation> {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    const SceneNumbers<double>& p = flights.parameters();
    if (orbit.size() == 0) return response_violation(flights, orbit);
    return first_of_legs(p, orbit, grazing, [&](std::size_t i) {
      const Leg leg = leg_of(orbit, i, p.oscillator.frequency, grazing);
      return flights.with_arc(leg.flight, [&](const auto& arc) { return leg_violation(p, arc, leg); });
    });
  });
}
/// With a loose mass.
std::optional<Violation> violation_of_both(const FollowedScene& scene, const Orbit& orbit,
                                           std::optional<std::size_t> grazing) {
  return with_arcs_of_main(scene, [&]<Effects E>() -> std::optional<Violation> {
    const HousingFlights<double, E> flights{numbers_of<double>(scene)};
    const SceneNumbers<double>& p = flights.parameters();
    return first_of_legs(p, orbit, grazing, [&](std::size_t i) {
      FlightOfBoth<double> flight = flight_of_both(orbit, i);
      const Leg leg = leg_of(orbit, i, p.oscillator.frequency, grazing, flights.beside(flight));
      if (leg.leaves_graze || (i == grazing && flight.leaves == Event::Kind::strike)) flight.coordinate = 0;
      const Side wall = flight.arrives == Event::Kind::strike ? flight.to : Side::none;
      return flights.with_arc(flight, [&](const auto& arc) { return leg_violation(p, arc, leg, wall); });
    });
  });
}

}  // namespace

std::optional<Violation> violation(const FollowedScene& scene, const Orbit& orbit, std::optional<std::size_t> grazing) {
  if (const auto slow = impact_without_rebound(scene, orbit); slow && slow != grazing)
    return Violation{Violation::Kind::no_rebound, *slow, {}};
  if (has_friction(scene.friction) || orbit.halts()) {
    const std::vector<Violation> found = slip_violations(scene, orbit, grazing);
    return found.empty() ? std::nullopt : std::optional(found.front());
  }
  const SceneNumbers<double> of_scene = numbers_of<double>(scene);
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (const Flight<double> flight = detail::flight_of<double>(orbit, i);
        flight.may_vanish(of_scene) && !(flight.begin < flight.end))
      return Violation{Violation::Kind::ends_early, i, {}};
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (i != grazing && !points_right(orbit.events[i])) {
      const Violation pulls{Violation::Kind::pulls, i, {}};
      return orbit.events[i].kind == Event::Kind::separation ? told_apart(of_scene, orbit, pulls) : pulls;
    }
  const bool has_both = has_loose_mass(scene.loose);
  return has_both ? violation_of_both(scene, orbit, grazing) : violation_of_one(scene, orbit, grazing);
}

}  // namespace clatter::branches
