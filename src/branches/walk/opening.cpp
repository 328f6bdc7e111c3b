#include "branches/walk/opening.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "branches/equations/flight.hpp"
#include "branches/equations/newton.hpp"
#include "branches/walk/ceasing.hpp"
#include "branches/walk/halt_at_soft_stop.hpp"
#include "branches/walk/halves.hpp"
#include "branches/walk/slip_violation.hpp"
#include "branches/walk/touch.hpp"
#include "branches/walk/violation.hpp"

namespace clatter::branches {
namespace {

using Kind = Opening::Kind;

/// Acceleration at an event of a soft stop, that of the free motion.
double acceleration(const SceneNumbers<double>& p, const OrbitEvent& event, double offset) {
  return p.force_at(event.phase).value + p.oscillator.load - 2 * p.oscillator.damping * event.before -
         p.oscillator.stiffness * (p.position(event.side) + offset) - sign_of(event.heading()) * p.friction.kinetic;
}

/// An orbit with a graze as if a contact or an interruption that lasts for `advance` of the phase began and ended
/// there.
Orbit with_short(const FollowedScene& scene, const Orbit& orbit, std::size_t graze, double advance) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const OrbitEvent middle = orbit.events[graze];
  const double relaxation = p.soft_stop(middle.side).relaxation(), time = advance / p.oscillator.frequency;
  OrbitEvent begin = middle, end = middle;
  const double a = acceleration(p, middle, -relaxation * middle.before);
  double before = time / 2;  // from the beginning to the extremum
  if (middle.kind == Event::Kind::separation && middle.before == 0) {
    // v t + a t^2/2 + r (v + a t) = 0, the end of a contact that begins with v: the mass turns after the time -v/a
    before = time * (time / 2 + relaxation) / (time + relaxation);
    begin.kind = Event::Kind::touch;
  } else {
    begin.kind = middle.kind == Event::Kind::separation ? Event::Kind::renewal : Event::Kind::separation;
    if (relaxation == 0 && presses(middle.kind)) end.kind = Event::Kind::touch;
  }
  begin.phase = middle.phase - p.oscillator.frequency * before, begin.before = middle.before - a * before;
  end.phase = begin.phase + advance, end.before = begin.before + a * time;
  begin.other.place -= middle.other.before * before, end.other.place += middle.other.before * (time - before);
  Orbit out = orbit;
  out.events[graze] = end;
  return out.with(begin, graze);
}

/// An orbit with a stick on a stop as if the mass struck that first, and slipped back for `advance` of the phase.
Orbit with_rebound(const FollowedScene& scene, const Orbit& orbit, std::size_t stick, double advance) {
  const Side stop = orbit.heading_before(stick);
  const SceneNumbers<double> p = numbers_of<double>(scene);
  OrbitEvent event{stop, orbit.events[stick].phase}, halt = orbit.events[stick];
  const double a = acceleration_from(scene, halt, opposite(stop));
  const double time = advance / p.oscillator.frequency;
  event.before = a * time / p.law(stop).share_at_rest();
  halt.phase += advance, halt.place -= a * time * time / 2;
  Orbit out = orbit;
  out.events[stick] = halt;
  return out.with(event, stick);
}

/// An orbit with a stick as if the mass turned there, and slipped back for `advance` of the phase: the push back falls
/// through the level by then. With -c its slope by the time, and t the time, it begins c t/2 above the level and moves
/// the mass by c t^3/12.
Orbit with_turn(const FollowedScene& scene, const Orbit& orbit, std::size_t stick, double advance) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  OrbitEvent turn = orbit.events[stick], halt = turn;
  turn.kind = Event::Kind::reversal, turn.side = opposite(orbit.heading_before(stick));
  const double nu = p.oscillator.frequency, sign = sign_of(turn.side);
  const double needed = p.friction.static_level - sign * p.standing_force(p.middle() + turn.place, turn.held_by());
  const double at_level = fall_near(p, turn.side, turn.phase, needed), c = std::abs(nu * p.force_at(at_level).slope);
  turn.phase = at_level - advance / 2, halt.phase = at_level + advance / 2;
  halt.place += sign * c * std::pow(advance / nu, 3) / 12;
  Orbit out = orbit;
  out.events[stick] = halt;
  return out.with(turn, stick);
}

/// An orbit with a stick as if the push the other way came above the level at its crest, and the mass slipped from then
/// on for `advance` of the phase. With P - C b^2/2 the push at a phase b from the crest, P = C = |f| under a sine, a
/// slip from b = -r on ends at b = 2r, and moves the mass by 9/8 C r^4/nu^2.
Orbit with_release(const FollowedScene& scene, const Orbit& orbit, std::size_t stick, double advance) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const double r = advance / 3;
  OrbitEvent held = orbit.events[stick], halt = held;
  held.side = opposite(halt.side);
  const double sign = sign_of(held.side);
  const Crest crest = crest_after(p, held, held.side);
  halt.phase = crest.phase + 2 * r;
  const double k =
      p.oscillator.stiffness + (held.held_by() == Side::none ? 0.0 : p.soft_stop(held.held_by()).stiffness);
  const double balance = p.standing_force(p.middle() + held.place, held.held_by());
  if (k != 0) held.place += (balance + sign * (crest.height - crest.bend * r * r / 2 - p.friction.static_level)) / k;
  halt.place = held.place + sign * 9 / 8.0 * crest.bend * std::pow(r, 4) / std::pow(p.oscillator.frequency, 2);
  Orbit out = orbit;
  out.events[stick] = halt;
  return out.with(held, stick);
}

}  // namespace

Orbit with_opening(const FollowedScene& scene, const Orbit& orbit, const Opening& opening, double advance) {
  switch (opening.kind) {
    case Kind::contact:
      return with_short(scene, orbit, opening.event, advance);
    case Kind::rebound:
      return with_rebound(scene, orbit, opening.event, advance);
    case Kind::turn:
      return with_turn(scene, orbit, opening.event, advance);
    case Kind::release:
      return with_release(scene, orbit, opening.event, advance);
    case Kind::within:
    case Kind::outside:
      return with_halt_beside(scene, orbit, opening.event, advance, opening.kind == Kind::within);
  }
  return orbit;
}

namespace {

/// Another opening of that kind in a violation: motion may be symmetric about another place than x = 0, or in a scene
/// that isn't, and then it comes to both halves at once.
std::optional<Opening> another(Kind kind, const Violation& found) {
  if (kind == Kind::contact && found.kind == Violation::Kind::passes_through &&
      found.turning.kind != Event::Kind::impact)
    return Opening{kind, found.event + 1};
  if ((kind == Kind::turn || kind == Kind::release) && found.kind == Violation::Kind::slips)
    return Opening{kind, found.event};
  return std::nullopt;
}

/// The number of a halt beside a soft stop in an orbit that has opened at it.
std::size_t halt_of(const Opening& opening, const Orbit& orbit) {
  return opening.event + !halts(orbit.events[opening.event].kind);
}
/// The condition that what has begun at an event `first` lasts for `advance` of the phase.
Condition lasts(const FollowedScene& scene, const Orbit& orbit, const Opening& opening, std::size_t first,
                double advance) {
  using enum Condition::Kind;
  if (opening.is_of_soft_stop()) {
    const std::size_t number = halt_of(opening, orbit);
    const OrbitEvent& halt = orbit.events[number];
    const SceneNumbers<double> p = numbers_of<double>(scene);
    const Side side = soft_stop_at_halt(scene, halt);
    return {.kind = on_stop,
            .event = number,
            .without = {},
            .amount = sign_of(side) * (p.middle() + halt.place - p.position(side)),
            .side = side};
  }
  // the stick before an early release lasts on to the crest, beside which the slip ends
  const double length =
      opening.kind == Kind::release ? orbit.event(first + 1).phase - orbit.event(first).phase : advance;
  return {.kind = duration, .event = first, .amount = length};
}
/// The direction in which what has begun grows, in the unknowns.
Vector growth(const OrbitEquations& of, const Opening& opening, std::size_t first) {
  Vector longer(of.unknowns(), 0.0);
  if (opening.is_of_soft_stop()) {
    const std::size_t halt = halt_of(opening, of.shape());
    const OrbitEvent& event = of.shape().events[halt];
    const Side side = soft_stop_at_halt(of.scene(), event);
    longer[of.phase_of(halt) + 1] = sign_of(side) * (opening.kind == Kind::within ? 1 : -1);
    return longer;
  }
  longer[of.phase_of(first)] = -1;
  longer[of.phase_of((first + 1) % of.shape().size())] = 1;
  return longer;
}

/// Motion that is symmetric between stops that aren't alike comes to both at once: as it comes to lie within the one,
/// it strikes, or touches, the other one, too, at a halt that a violation has. As it comes to lie outside, it no longer
/// strikes that.
std::optional<Orbit> with_other_stop(const FollowedScene& scene, Orbit orbit, const Opening& opening,
                                     const Violation& found, double advance) {
  if (opening.kind == Kind::outside && found.kind == Violation::Kind::pulls &&
      orbit.events[found.event].kind == Event::Kind::impact)
    return halting_at_stop(scene, orbit, found.event);
  const std::size_t next = (found.event + 1) % orbit.size(), opened = halt_of(opening, orbit);
  if (opening.kind != Kind::within || found.kind != Violation::Kind::passes_through || next <= opened) return {};
  OrbitEvent& halt = orbit.events[next];
  const Side stop = orbit.heading_before(next);
  if (halt.kind != Event::Kind::reversal || halt.held_by() != Side::none) return {};
  if (is_soft(scene.stops, stop)) return with_halt_beside(scene, orbit, next, advance, true);
  const double time = advance / scene.oscillator.frequency, a = std::abs(acceleration_from(scene, halt, stop));
  halt = {stop, halt.phase, sign_of(stop) * a * time};
  return orbit;
}

/// Motion between the stops with what began at an event `first`.
struct Lasting {
  Orbit orbit;
  Vector at;
  std::size_t first;
};
/// The motion of which the slip, the contact or its interruption lasts for `advance` of the phase.
std::optional<Lasting> with_lasting(const Equations& equations, const FollowedScene& scene, const Orbit& orbit,
                                    const Opening& opening, double advance, double tolerance) {
  Lasting lasting{with_opening(scene, orbit, opening, advance), {}, opening.event};
  for (int times = 1; times <= 2; ++times) {
    const OrbitEquations there =
        equations(lasting.orbit, {lasts(scene, lasting.orbit, opening, lasting.first, advance)});
    auto at = solution(there, there.unknowns_of(scene, lasting.orbit), tolerance);
    if (!at) return std::nullopt;
    const auto violated = violation(there, *at);
    lasting.at = *std::move(at);
    if (!violated) return lasting;
    if (opening.is_of_soft_stop()) {
      std::optional<Orbit> both;
      const Orbit one = there.orbit_at(lasting.at);
      for (const Violation& found : slip_violations(there.scene_at(lasting.at), one, {}))
        if (!both) both = with_other_stop(scene, one, opening, found, advance);
      if (!both) return std::nullopt;
      lasting.orbit = *std::move(both);
      continue;
    }
    const auto second = another(opening.kind, *violated);
    if (!second) return std::nullopt;
    Orbit both = there.orbit_at(lasting.at);
    if (opening.kind == Kind::contact) both = both.with(violated->turning, second->event);
    lasting.orbit = with_opening(scene, both, *second, advance);
    if (second->event <= lasting.first) lasting.first += lasting.orbit.size() - there.shape().size();
  }
  return std::nullopt;
}

/// A motion in which something has begun at the event of the opening alone, or where its equations find another one.
std::optional<Opened> opened_once(const Equations& equations, const FollowedScene& scene, const Orbit& orbit,
                                  const Opening& opening, double tolerance) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const OrbitEvent& event = orbit.events[opening.event];
  const Side stop = opening.is_of_soft_stop() ? soft_stop_at_halt(scene, event) : event.side;
  const double of_stop = halts(event.kind) && !opening.is_of_soft_stop() ? 0.0 : p.soft_stop(stop).stiffness;
  const double rate = std::max(p.oscillator.frequency, std::sqrt(std::abs(p.oscillator.stiffness) + of_stop));
  for (const double turned_by : {1e-3, 1e-2, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const auto lasting =
        with_lasting(equations, scene, orbit, opening, p.oscillator.frequency / rate * turned_by, tolerance);
    if (!lasting) continue;
    const OrbitEquations there = equations(lasting->orbit, {});
    if (auto along = tangent(there, lasting->at, growth(there, opening, lasting->first)))
      return Opened{lasting->orbit, lasting->at, *std::move(along)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Opened> opened(const Equations& equations, const FollowedScene& scene, const Orbit& orbit,
                             const Opening& opening, double tolerance) {
  // a stop that the mass comes to strike has its mirror image elsewhere
  const bool on_stop = opening.kind == Kind::rebound || opening.is_of_soft_stop();
  const auto half = on_stop ? std::nullopt : half_of_free_slips(scene, orbit);
  if (!half) return opened_once(equations, scene, orbit, opening, tolerance);
  const auto begun = opened_once(equations, scene, *half, {opening.kind, opening.event % half->size()}, tolerance);
  if (!begun) return std::nullopt;
  const OrbitEquations of_half = equations(begun->orbit, {});
  const Orbit both = of_half.orbit_at(begun->at).whole();
  const OrbitEquations there = equations(both, {});
  Vector at = there.unknowns_of(of_half.scene_at(begun->at), both);
  if (violation(there, at)) return std::nullopt;
  return Opened{both, std::move(at), along_both_halves(begun->tangent)};
}

}  // namespace clatter::branches
