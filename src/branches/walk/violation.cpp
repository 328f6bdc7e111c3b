#include "branches/walk/violation.hpp"

#include <algorithm>
#include <cmath>

#include "branches/equations/links.hpp"
#include "branches/walk/flight_end.hpp"
#include "branches/walk/housing_violation.hpp"
#include "branches/walk/slip_violation.hpp"
#include "motion/contact.hpp"

namespace clatter::branches {
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
  if (path.arrives != Event::Kind::impact && crossing.resolved &&
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
  if ((renews || path.ends_in_graze) && crossing.resolved &&
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

/// Where two events of a soft stop are about to vanish, the proof may find a third one beside them: it is theirs.
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
  if (found.turning.kind == Event::Kind::impact) return found;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const Flight<double> flight = detail::flight_of<double>(orbit, i);
    const double distance = std::remainder(found.turning.phase - flight.begin, orbit.advance());
    if (vanishes(i) && std::abs(distance) < 2 * about) return {Violation::Kind::ends_early, i, {}};
  }
  return found;
}

/// Motion without events.
template <Effects E>
std::optional<Violation> response_violation(const Flights<double, E>& flights, const Orbit& orbit) {
  const SceneNumbers<double>& p = flights.parameters();
  return flights.with_response(
      orbit.pressed, [&](const auto& arc, const Response<double>& response) -> std::optional<Violation> {
        const Path path{0, 0, 0.0, orbit.advance() / p.oscillator.frequency, Side::none};
        if (orbit.pressed != Side::none) return separates(p.soft_stop(orbit.pressed), arc, path);
        for (const Side side : {Side::lower, Side::upper})  // begins beyond the stop
          if (const double sign = sign_of(side); sign * (arc.start().x - p.position(side)) > 0) {
            const double turn = std::atan2(sign * response.in_phase, sign * response.quadrature) - flights.lead();
            const Event::Kind turns = is_soft(p.stops, side) ? Event::Kind::separation : Event::Kind::impact;
            return Violation{Violation::Kind::passes_through, 0, {side, turn, 0.0, turns}};
          }
        return cut_short(p, arc, path);
      });
}

}  // namespace

std::optional<Violation> violation(const FollowedScene& scene, const Orbit& orbit, std::optional<std::size_t> grazing) {
  if (has_loose_mass(scene.loose)) return housing_violation(scene, orbit, grazing);
  if (has_friction(scene.friction) || orbit.halts()) {
    const std::vector<Violation> found = slip_violations(scene, orbit, grazing);
    return found.empty() ? std::nullopt : std::optional(found.front());
  }
  // next to its double zero in a graze, the sign of a soft stop's force is that of rounding
  constexpr double clear_of_rounding = 1e-6;
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
  return with_arcs(scene, [&]<Effects E>() -> std::optional<Violation> {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    const SceneNumbers<double>& p = flights.parameters();
    if (orbit.size() == 0) return response_violation(flights, orbit);
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      Flight<double> flight = detail::flight_of<double>(orbit, i);
      const bool without_speed = flight.leaves == Event::Kind::impact || std::abs(flight.coordinate) <= 1e-9;
      const bool leaves_graze = i == grazing && !presses(flight.leaves) && without_speed;
      if (leaves_graze) flight.coordinate = 0;
      Path path{i,         (i + 1) % orbit.size(), flight.begin, (flight.end - flight.begin) / p.oscillator.frequency,
                flight.to, flight.arrives};
      path.ends_in_graze = path.next == grazing && flight.arrives == Event::Kind::separation && !presses(flight.leaves);
      auto found = flights.with_arc(flight, [&](const auto& arc) {
        if (flight.leaves == Event::Kind::impact || leaves_graze) return cut_short(p, arc, path);
        const motion::SoftStop<double> stop = p.soft_stop(flight.from);
        const auto flown = [&](const auto& from) {
          if (presses(flight.leaves)) return separates(stop, from, path);
          return stop.damping == 0 ? cut_short(p, from, path) : free_within(p, stop, from, path);
        };
        if (i != grazing) return flown(arc);
        const double clear = std::min(clear_of_rounding / arc.constants().rate, path.length);
        path.begin += p.oscillator.frequency * clear, path.length -= clear;
        return flown(motion::Arc(arc.constants(), arc.at(clear), stop.position));
      });
      if (found && !(found->kind == Violation::Kind::pulls && found->event == grazing))
        return told_apart(p, orbit, *found);
    }
    return std::nullopt;
  });
}

}  // namespace clatter::branches
