#include "branches/walk/slip_violation.hpp"

#include <array>
#include <limits>

#include "branches/equations/links.hpp"
#include "branches/walk/flight_end.hpp"

namespace clatter::branches {
namespace {

constexpr double shortest = 1e-9;  // rad, of a slip

/// Whether friction holds a mass where an orbit says so, and lets it go where it says so.
template <Effects E>
std::optional<Violation> at_halt(const Flights<double, E>& flights, const Orbit& orbit, std::size_t i) {
  using enum Violation::Kind;
  const OrbitImpact& halt = orbit.impacts[i];
  const auto holds = [&](Side side) { return flights.left_to_level(halt.place, halt.phase, side) >= 0; };
  const auto release = [&](Side side) { return flights.hold(halt.place, halt.phase, side); };
  const Side before = orbit.heading_before(i), other = opposite(halt.side);
  if (halt.event == EventKind::reversal)
    return holds(halt.side) ? std::optional(Violation{sticks, i, {}}) : std::nullopt;
  if (!holds(halt.side) || !holds(other)) return Violation{slips, i, {}};
  if (release(halt.side) == std::numeric_limits<double>::infinity()) return Violation{stays, i, {}};
  if (!(sign_of(before) * flights.acceleration(halt.place, halt.phase, before) <= 0)) return Violation{runs_on, i, {}};
  return release(other) < release(halt.side) ? std::optional(Violation{slips, i, {}}) : std::nullopt;
}

/// Whether a flight meets the stop ahead, or halts, at its end and not before.
template <Effects E>
std::optional<Violation> in_flight(const Flights<double, E>& flights, const Orbit& orbit, std::size_t i) {
  const Flight<double> flight = detail::flight_of<double>(orbit, i);
  const SceneNumbers<double>& p = flights.parameters();
  const Side ahead = orbit.impacts[i].heading();
  const double sign = sign_of(ahead), start = flights.start(flight), nu = p.oscillator.frequency,
               length = (flight.end - start) / nu;
  if (!(length > 0)) return Violation{Violation::Kind::slips, i, {}};
  if (flight.arrives == EventKind::stick && length * nu < shortest) return Violation{Violation::Kind::vanishes, i, {}};
  return flights.with_arc(flight, [&](const auto& arc) -> std::optional<Violation> {
    const Margin gap{sign * (p.position(ahead) - arc.anchor()), -sign, 0.0}, velocity{0.0, 0.0, sign};
    const auto crossing = motion::first_crossing(arc, std::array{gap, velocity}, length);
    const motion::Motion<double>& m = crossing.motion;
    if (crossing.resolved && crossing.margin == 2) return std::nullopt;
    const bool meets = crossing.margin == 0;
    if (crossing.resolved && meets != halts(flight.arrives) &&
        is_at_end(crossing.elapsed, length, meets ? m.x : m.v, meets ? m.v : m.a, nu))
      return std::nullopt;
    if (meets) return Violation{Violation::Kind::passes_through, i, {ahead, flight.end, 0.0}};
    const double turn = turning_time(arc, velocity, crossing.elapsed);
    return Violation{
        Violation::Kind::halts,
        i,
        {ahead, start + nu * turn, 0.0, 0.0, EventKind::stick, static_cast<double>(arc.at(turn).x) - p.middle()}};
  });
}

}  // namespace

std::optional<Violation> slip_violation(const FollowedScene& scene, const Orbit& orbit,
                                        std::optional<std::size_t> grazing) {
  return with_arcs(scene, [&]<Effects E>() -> std::optional<Violation> {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const OrbitImpact& event = orbit.impacts[i];
      if (i == grazing) continue;
      if (!halts(event.event) && !(sign_of(event.side) * event.before > 0))
        return Violation{Violation::Kind::pulls, i, {}};
      if (halts(event.event))
        if (const auto found = at_halt(flights, orbit, i)) return found;
    }
    for (std::size_t i = 0; i < orbit.size(); ++i)
      if (const auto found = in_flight(flights, orbit, i)) return found;
    return std::nullopt;
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
