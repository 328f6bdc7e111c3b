#include "branches/walk/halt_at_soft_stop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "branches/equations/flight.hpp"

namespace clatter::branches {

Side soft_stop_at_halt(const FollowedScene& scene, const OrbitEvent& halt) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const auto off = [&](Side side) {
    return is_soft(scene.stops, side) ? std::abs(p.middle() + halt.place - p.position(side))
                                      : std::numeric_limits<double>::infinity();
  };
  return off(Side::lower) < off(Side::upper) ? Side::lower : Side::upper;
}

double acceleration_from(const FollowedScene& scene, const OrbitEvent& halt, Side side) {
  return with_arcs(scene, [&]<Effects E>() {
    return Flights<double, E>{numbers_of<double>(scene)}.acceleration(standing_at(halt), side);
  });
}

namespace {

/// The time, and the speed, with which a mass at rest has gone so far that way + relaxation * speed is a distance, by
/// its acceleration and the jerk.
struct Start {
  double time, speed;
};
Start start_over(double distance, double relaxation, double a, double jerk) {
  const auto root = [](double x) { return x > 0 ? x : std::numeric_limits<double>::infinity(); };
  double time = std::min({root(std::sqrt(2 * distance / a)), root(std::cbrt(6 * distance / jerk)),
                          root(distance / (relaxation * a)), root(std::sqrt(2 * distance / (relaxation * jerk)))});
  for (int iteration = 0; iteration < 20; ++iteration) {
    const double speed = time * (a + time * jerk / 2), gains = a + time * jerk;
    time -= (time * time * (a / 2 + time * jerk / 6) + relaxation * speed - distance) / (speed + relaxation * gains);
  }
  return {time, time * (a + time * jerk / 2)};
}

}  // namespace

Orbit with_halt_beside(const FollowedScene& scene, const Orbit& orbit, std::size_t number, double advance,
                       bool within) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const double nu = p.oscillator.frequency;
  OrbitEvent halt = orbit.events[number];
  const Side side = soft_stop_at_halt(scene, halt), from = orbit.heading_before(number);
  const double relaxation = p.soft_stop(side).relaxation(), sign = sign_of(side);
  const double braked = std::abs(acceleration_from(scene, halt, from)), depth = braked * std::pow(advance / nu, 2) / 2;
  halt.place += sign * (within ? depth : -depth), halt.contact = within ? side : Side::none;
  Orbit out = orbit;
  out.events[number] = halt;
  // after it
  const bool enters = halt.side == side;
  if (enters != within) {
    const OrbitEvent next = orbit.event(number + 1);
    const Flight<double> flight{halt.side, halt.phase, halt.place, side,          next.phase,
                                halt.kind, next.kind,  false,      halt.held_by()};
    const bool sticks = halt.kind == Event::Kind::stick;
    const double begin = with_arcs(scene, [&]<Effects E>() { return Flights<double, E>{p}.start(flight); });
    const double a =
        sticks ? p.friction.static_level - p.friction.kinetic : std::abs(acceleration_from(scene, halt, halt.side));
    const double jerk = sticks ? std::abs(nu * p.force_at(begin).slope) : 0.0;
    const Start start = start_over(depth, within ? relaxation : 0.0, a, jerk);
    out = out.with({side, begin + nu * start.time, sign_of(halt.side) * start.speed,
                    within ? Event::Kind::separation : Event::Kind::touch},
                   number + 1);
  }
  // before it
  const bool entered = from == side;
  if (entered ? !within : within == (relaxation == 0)) return out;
  double time = advance / nu;
  if (!entered && within) {
    const double least = relaxation * relaxation - 2 * depth / braked;
    time = relaxation - std::sqrt(std::max(least, 0.0));
  }
  const Event::Kind kind = entered ? Event::Kind::touch : within ? Event::Kind::renewal : Event::Kind::separation;
  return out.with({side, halt.phase - nu * time, sign_of(from) * braked * time, kind}, number);
}

namespace {

/// A halt comes to the position of a soft stop, from within or from outside. There the touch and the separation between
/// the two, and a renewal just before it, are none, and it tells by itself whether the mass is in contact after it.
HaltChange passing(const FollowedScene& scene, const Orbit& all, std::size_t number, Side stop) {
  Orbit orbit = all.from_event(number);
  OrbitEvent& halt = orbit.events[0];
  const bool was_within = halt.held_by() != Side::none, entered = orbit.heading_before(0) == stop,
             enters = halt.side == stop, damped = numbers_of<double>(scene).soft_stop(stop).damping != 0;
  halt.contact = enters ? stop : Side::none;
  const OrbitEvent after = orbit.event(1), before = orbit.event(orbit.size() - 1);
  const Side side_before = orbit.mirrored ? opposite(before.side) : before.side;
  const Event::Kind none = entered ? Event::Kind::touch : damped ? Event::Kind::renewal : Event::Kind::separation;
  if (orbit.size() > 1 && before.kind == none && side_before == stop) orbit.events.pop_back();
  if (orbit.size() > 1 && after.kind == (enters ? Event::Kind::touch : Event::Kind::separation) && after.side == stop)
    orbit = orbit.without(1);
  const HaltForm form = orbit.events[0].kind == Event::Kind::stick ? HaltForm::stick : HaltForm::reversal;
  return {SpecialKind::graze,
          orbit,
          {.kind = Condition::Kind::on_stop, .event = 0, .without = {}, .side = stop},
          form,
          form,
          was_within ? Opening::Kind::outside : Opening::Kind::within};
}
/// Whether the mass passes the position of a soft stop just before a halt, or just after it.
bool is_beside_contact(const Orbit& orbit, std::size_t halt) {
  constexpr double near = 0.1;  // rad
  const auto is_near = [&](std::size_t i) {
    const OrbitEvent one = orbit.event(i), next = orbit.event(i + 1);
    return next.phase - one.phase < near && (is_of_soft_stop(one.kind) || is_of_soft_stop(next.kind));
  };
  return is_near(halt) || is_near(halt + orbit.size() - 1);
}

}  // namespace

void add_passing(const FollowedScene& scene, const Orbit& orbit, const std::vector<Violation>& violations,
                 std::vector<HaltChange>& changes) {
  const auto is_beside = [&](std::size_t halt) {
    return is_beside_contact(orbit, halt) || std::ranges::any_of(violations, [&](const Violation& violation) {
             // from two events after it to the one before it
             return (halt + 2 * orbit.size() + 1 - violation.event) % orbit.size() < 4 || orbit.size() < 4;
           });
  };
  for (std::size_t i = 0; i < orbit.size(); ++i)
    for (const Side stop : {Side::lower, Side::upper})
      if (halts(orbit.events[i].kind) && is_soft(scene.stops, stop) && is_beside(i))
        changes.push_back(passing(scene, orbit, i, stop));
}

}  // namespace clatter::branches
