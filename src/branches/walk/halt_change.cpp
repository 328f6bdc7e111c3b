#include "branches/walk/halt_change.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "branches/equations/flight.hpp"
#include "branches/equations/newton.hpp"
#include "branches/walk/ceasing.hpp"
#include "branches/walk/halt_at_soft_stop.hpp"
#include "branches/walk/slip_violation.hpp"

namespace clatter::branches {
namespace {

using Kind = Condition::Kind;

Condition level(Kind kind, std::size_t halt, Side side) {
  return {.kind = kind, .event = halt, .without = {}, .side = side};
}

/// Calls `function(flights)` with the flights of a scene.
template <class Function>
double of_flights(const FollowedScene& scene, Function&& function) {
  return with_arcs(scene, [&]<Effects E>() { return function(Flights<double, E>{numbers_of<double>(scene)}); });
}
/// How long friction holds a mass where it halts against a push to its side, rad.
double held(const FollowedScene& scene, const OrbitEvent& halt) {
  return of_flights(scene, [&](const auto& flights) { return flights.releases().hold(standing_at(halt), halt.side); });
}
/// Whether friction holds a mass against a push to a side at the instant at which it halts.
bool holds(const FollowedScene& scene, const OrbitEvent& halt, Side side) {
  return of_flights(scene, [&](const auto& flights) { return flights.left_to_level(standing_at(halt), side); }) >= 0;
}

/// Whether the force that pushes a halting mass to its side rises.
bool push_rises(const FollowedScene& scene, const OrbitEvent& halt) {
  return sign_of(halt.side) * numbers_of<double>(scene).force_at(halt.phase).slope > 0;
}

/// Whether motion jumps where a push comes to the static level.
bool motion_jumps(const FollowedScene& scene) { return scene.friction.static_level > scene.friction.kinetic; }

/// The velocity falls to 0 in a slip, which goes on at once: beyond, after a stick. If that is a long one, as the
/// static level is above the kinetic one, the slip goes on here as from a reversal to where it was going.
HaltChange grazing(const Orbit& orbit, const FollowedScene& scene, const Violation& found, bool jumps) {
  const std::size_t halt = found.event + 1;
  OrbitEvent pause = found.turning;
  pause.kind = Event::Kind::reversal;
  HaltChange change{SpecialKind::grazing_sliding, jumps ? orbit.with(pause, halt) : with_halts(scene, orbit),
                    level(jumps ? Kind::kinetic : Kind::level, halt, found.turning.side), HaltForm::none};
  if (!jumps) change.beyond = HaltForm::stick;
  return change;
}

/// An event of an orbit and the stick after it as one stick.
Orbit merged(const Orbit& orbit, std::size_t event = 0) {
  Orbit one = orbit.without(event);
  one.events[event].phase = orbit.events[event].phase;
  return one;
}

/// The length, rad, of the slip from an event to a stick; infinite if it can't vanish. One that a push at a static
/// level above the kinetic one begins can't, however short it is.
double length_of_slip(const FollowedScene& scene, const OrbitEvent& from, const OrbitEvent& to) {
  if (to.kind != Event::Kind::stick || is_of_soft_stop(from.kind) || (halts(from.kind) && motion_jumps(scene)))
    return std::numeric_limits<double>::infinity();
  return to.phase - from.phase - (from.kind == Event::Kind::stick ? held(scene, from) : 0.0);
}

/// A reversal comes to be a stick: a short one, or a longer one at once, or when the slip after it has shrunk to
/// nothing.
HaltChange sticking(const Orbit& orbit, const FollowedScene& scene, std::size_t i, bool jumps) {
  const OrbitEvent& halt = orbit.events[i];
  HaltChange change{SpecialKind::crossing_sliding, orbit.with_kind(i, Event::Kind::stick),
                    level(Kind::level, i, halt.side), HaltForm::reversal, HaltForm::stick};
  if (push_rises(scene, halt)) return change;
  change.kind = SpecialKind::switching_sliding;
  if (jumps) {  // to a long stick, while the slip after the reversal doesn't vanish
    change.orbit = orbit, change.beyond.reset();
    return change;
  }
  change.before.reset();
  if (orbit.event(i + 1).kind == Event::Kind::stick)
    change.orbit = merged(orbit.from_event(i)), change.condition.event = 0;
  return change;
}

/// A slip to a stick comes as far as a stop: beyond, the mass strikes that.
std::optional<HaltChange> reaching(const Orbit& orbit, std::size_t halt) {
  if (orbit.events[halt].kind != Event::Kind::stick) return std::nullopt;
  HaltChange change{SpecialKind::graze, orbit, level(Kind::on_stop, halt, orbit.heading_before(halt)), HaltForm::stick};
  change.opens = Opening::Kind::rebound;
  return change;
}

/// A stick has shrunk to nothing, or is released the other way sooner. A release where the push falls, or touches the
/// level at its crest, begins a short slip from nothing; with a static level above the kinetic one a long slip.
HaltChange slipping(const Orbit& orbit, const FollowedScene& scene, std::size_t i, bool jumps) {
  const OrbitEvent& halt = orbit.events[i];
  const Side other = opposite(halt.side);
  const bool held = holds(scene, halt, halt.side);
  HaltChange change{SpecialKind::switching_sliding, orbit, level(Kind::level, i, halt.side), HaltForm::stick};
  if (!jumps) change.opens = Opening::Kind::turn;
  if (!holds(scene, halt, other)) {
    change.condition.side = other;
    return change;
  }
  if (held) {
    change.kind = SpecialKind::release_tangency, change.condition = level(Kind::tangency, i, other);
    if (!jumps) change.opens = Opening::Kind::release;
    return change;
  }
  if (!push_rises(scene, halt)) return change;
  change.opens.reset();
  const bool goes_on = orbit.heading_before(i) == halt.side;
  change.kind = goes_on ? SpecialKind::grazing_sliding : SpecialKind::crossing_sliding;
  change.beyond = goes_on ? HaltForm::none : HaltForm::reversal;
  return change;
}

}  // namespace

Orbit formed(const FollowedScene& scene, const Orbit& orbit, std::size_t halt, HaltForm form) {
  constexpr double at_once = 1e-6;  // rad
  const bool goes_on = orbit.heading_before(halt) == orbit.events[halt].side;
  Orbit out = orbit;
  for (std::size_t i = orbit.size(); i-- > 0;) {
    const OrbitEvent& other = orbit.events[i];
    const bool alike = halts(other.kind) && (orbit.heading_before(i) == other.side) == goes_on &&
                       std::abs(held(scene, other)) <= at_once;
    if (i != halt && !alike) continue;
    if (form == HaltForm::none)
      out = out.without(i);
    else
      out.events[i].kind = form == HaltForm::stick ? Event::Kind::stick : Event::Kind::reversal;
  }
  return out;
}

namespace {

/// The first of the repetitions of an orbit, if it has an odd number of them.
Orbit first_of_odd(const Orbit& orbit, double tolerance) {
  for (const int parts : {3, 5, 7}) {
    const std::size_t size = orbit.size() / static_cast<std::size_t>(parts);
    if (orbit.mirrored || orbit.size() % static_cast<std::size_t>(parts) != 0 || orbit.half_turns % (2 * parts) != 0)
      continue;
    const Orbit one{{orbit.events.begin(), orbit.events.begin() + static_cast<std::ptrdiff_t>(size)},
                    orbit.half_turns / parts};
    const Orbit all = one.repeated(parts);
    const bool repeats = std::ranges::equal(all.events, orbit.events, [&](const OrbitEvent& a, const OrbitEvent& b) {
      return a.side == b.side && a.kind == b.kind && std::abs(a.phase - b.phase) <= tolerance &&
             std::abs(a.coordinate() - b.coordinate()) <= tolerance * (std::abs(a.coordinate()) + tolerance);
    });
    if (repeats) return first_of_odd(one, tolerance);
  }
  return orbit;
}

/// Whether motion may be its own mirror image: between stops that are each other's, or where it doesn't meet them.
bool may_be_mirrored(const FollowedScene& scene, const Orbit& orbit, const Condition& condition) {
  if (is_symmetric(scene)) return true;
  return condition.kind != Kind::on_stop && scene.oscillator.stiffness != 0 && is_odd_by_half(scene.oscillator.shape) &&
         orbit.is_of_free_halts();
}

/// A change that comes to the motion in each of its repetitions, or also in its mirror image, as that of the first one:
/// the equations of all of them at once are singular.
HaltChange once_of(HaltChange change, const FollowedScene& scene) {
  constexpr double same = 1e-4;
  const Orbit first = first_of_odd(change.orbit, same),
              once = first.half_if_same(same, may_be_mirrored(scene, first, change.condition));
  const std::size_t repetition = change.condition.event / once.size();
  if (once.mirrored && repetition % 2 == 1) change.condition.side = opposite(change.condition.side);
  change.condition.event %= once.size();
  change.orbit = once;
  return change;
}

/// Motion may come to one that repeats sooner, or is symmetric, though its halts differ beside it: some have a length
/// there, and some are none. This is that motion, with the halt of the change.
void join(ExactGraze& exact, const HaltChange& change) {
  constexpr double same = 1e-6;
  const bool symmetric = may_be_mirrored(exact.scene, exact.orbit, change.condition);
  const OrbitEvent& halt = exact.orbit.events[exact.event];
  Orbit once;
  if (exact.orbit.heading_before(exact.event) != halt.side) {
    const HaltForm form = change.condition.kind == Kind::on_stop ? *change.before : HaltForm::stick;
    once = formed(exact.scene, exact.orbit, exact.event, form).half_if_same(same, symmetric);
  } else {
    const Orbit without = formed(exact.scene, exact.orbit, exact.event, HaltForm::none);
    const auto later = std::ranges::upper_bound(without.events, halt.phase, {}, &OrbitEvent::phase);
    const auto number = static_cast<std::size_t>(later - without.events.begin());
    once = without.with(halt, number).once_with_graze(number, symmetric);
  }
  if (once.half_turns == exact.orbit.half_turns) return;
  const auto place = std::ranges::find_if(once.events, [&](const OrbitEvent& event) {
    const double turns = (event.phase - halt.phase) / once.advance();
    return halts(event.kind) && std::abs(turns - std::round(turns)) * once.advance() <= same;
  });
  if (place == once.events.end()) return;
  exact = {exact.scene, once, static_cast<std::size_t>(place - once.events.begin()), true};
}

std::optional<ExactGraze> solved(const OrbitEquations& there, const FollowedScene& near, const HaltChange& change,
                                 double within, double tolerance) {
  const Vector guess = there.unknowns_of(near, change.orbit);
  const auto exact = solution(there, guess, tolerance);
  if (!exact || std::abs(exact->back() - guess.back()) > within) return std::nullopt;
  ExactGraze found{there.scene_at(*exact), there.orbit_at(*exact), change.condition.event};
  if (change.before) join(found, change);
  return found;
}

}  // namespace

std::optional<ExactGraze> exact_change(const Equations& equations, const FollowedScene& near, const HaltChange& change,
                                       bool symmetric_scenes, double within, double tolerance) {
  const OrbitEquations there = equations(change.orbit, {change.condition});
  if (change.kind == SpecialKind::motion_ceases) return where_motion_ceases(there, near, change.orbit, within);
  const HaltChange once = once_of(change, near);
  const bool repeats = once.orbit.half_turns != change.orbit.half_turns;
  auto exact = repeats ? solved(equations(once.orbit, {once.condition}), near, once, within, tolerance)
                       : solved(there, near, change, within, tolerance);
  if (!exact) return exact;
  if (exact->orbit.mirrored && !change.orbit.mirrored && !symmetric_scenes) exact->orbit = exact->orbit.whole();
  exact->joins = exact->orbit.half_turns != change.orbit.half_turns;
  return exact;
}

namespace {

/// An orbit without slips that vanish with its first one: those of its repetitions, or of its mirror image.
Orbit without_short_slips(const FollowedScene& scene, Orbit orbit, double length) {
  constexpr double about_to_vanish = 1e-3;  // rad
  for (std::size_t i = orbit.size() - 1; i-- > 1;)
    if (length_of_slip(scene, orbit.events[i], orbit.events[i + 1]) < std::max(about_to_vanish, length))
      orbit = merged(orbit, i);
  return orbit;
}

}  // namespace

std::optional<HaltChange> vanishing_slip(const OrbitEquations& equations, const CurvePoint& at,
                                         double about_to_vanish) {
  const FollowedScene scene = equations.scene_at(at.at);
  const Orbit orbit = equations.orbit_at(at.at);
  if (orbit.size() < 2) return std::nullopt;
  const auto length = [&](std::size_t i) { return length_of_slip(scene, orbit.event(i), orbit.event(i + 1)); };
  std::size_t first = 0;
  for (std::size_t i = 1; i < orbit.size(); ++i) first = length(i) < length(first) ? i : first;
  if (!(length(first) < about_to_vanish)) return std::nullopt;
  const OrbitEvent& from = orbit.events[first];
  const Orbit one = without_short_slips(scene, merged(orbit.from_event(first)), 2 * std::max(length(first), 0.0));
  if (from.kind == Event::Kind::impact)
    return HaltChange{SpecialKind::graze, one, level(Kind::on_stop, 0, from.side), {}, HaltForm::stick};
  if (from.kind == Event::Kind::stick)
    return HaltChange{SpecialKind::release_tangency, one, level(Kind::tangency, 0, from.side), {}, HaltForm::stick};
  return HaltChange{SpecialKind::switching_sliding, one, level(Kind::level, 0, from.side), {}, HaltForm::stick};
}

namespace {

/// The change that a violation shows, if it is one of halts.
std::optional<HaltChange> of_violation(const OrbitEquations& equations, const CurvePoint& at, const Violation& found) {
  const FollowedScene scene = equations.scene_at(at.at);
  const Orbit orbit = equations.orbit_at(at.at);
  const std::size_t i = found.event;
  const bool jumps = motion_jumps(scene);
  switch (found.kind) {
    case Violation::Kind::passes_through:
      if (!is_impact(found.turning.kind) || is_soft(scene.stops, found.turning.side)) return std::nullopt;
      return reaching(orbit, (i + 1) % orbit.size());
    case Violation::Kind::halts:
      return grazing(orbit, scene, found, jumps);
    case Violation::Kind::runs_on:
      return HaltChange{SpecialKind::grazing_sliding, orbit, level(Kind::kinetic, i, orbit.heading_before(i)),
                        HaltForm::stick};
    case Violation::Kind::sticks:
      return sticking(orbit, scene, i, jumps);
    case Violation::Kind::slips:
      return slipping(orbit, scene, i, jumps);
    case Violation::Kind::stays:
      return HaltChange{SpecialKind::release_tangency, orbit, level(Kind::tangency, i, orbit.events[i].side),
                        HaltForm::stick};
    default:
      return std::nullopt;
  }
}

/// The releases that are about to vanish at the crest of the force.
void add_releases_at_crest(const OrbitEquations& equations, const CurvePoint& at, std::vector<HaltChange>& changes) {
  constexpr double near_crest = 0.1;  // rad
  const FollowedScene scene = equations.scene_at(at.at);
  const Orbit orbit = equations.orbit_at(at.at);
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent& stick = orbit.events[i];
    if (stick.kind != Event::Kind::stick) continue;
    const double before = of_flights(scene, [&](const auto& flights) {
      const auto& releases = flights.releases();
      return releases.hold_to_crest(standing_at(stick), stick.side) - releases.hold(standing_at(stick), stick.side);
    });
    if (before < near_crest)
      changes.push_back({SpecialKind::release_tangency, orbit, level(Kind::tangency, i, stick.side), HaltForm::stick});
  }
}

}  // namespace

bool jumps_to_stick(const FollowedScene& scene, const Orbit& orbit, std::size_t reversal) {
  const OrbitEvent& halt = orbit.events[reversal];
  return motion_jumps(scene) && holds(scene, halt, halt.side);
}

bool slips_on_from_stop(const FollowedScene& scene, const Orbit& orbit, std::size_t stick) {
  const OrbitEvent& halt = orbit.events[stick];
  const Side away = opposite(orbit.heading_before(stick));
  return sign_of(away) * acceleration_from(scene, halt, away) > 0;
}

std::vector<HaltChange> halt_changes(const OrbitEquations& equations, const Narrowed& found,
                                     const std::vector<Violation>& violations) {
  constexpr double about_to_cease = 0.1;  // rad
  const FollowedScene scene = equations.scene_at(found.last_good.at);
  const Orbit orbit = equations.orbit_at(found.last_good.at);
  if (hardly_slips(scene, orbit, about_to_cease))
    return {{SpecialKind::motion_ceases, orbit, level(Kind::tangency, 0, orbit.events[0].side)}};
  std::vector<HaltChange> changes;
  // as a slip vanishes, which violation is found is up to rounding, and its equations may hold there, too
  if (const auto change = vanishing_slip(equations, found.last_good)) changes.push_back(*change);
  for (const Violation& violation : violations)
    if (const auto change = of_violation(equations, found.beyond, violation)) changes.push_back(*change);
  add_releases_at_crest(equations, found.last_good, changes);
  add_passing(scene, orbit, violations, changes);
  return changes;
}

bool slip_vanishes_beside(const Equations& builder, const OrbitEquations& walked, const CurvePoint& at,
                          bool symmetric_scenes, double tolerance) {
  const auto change = vanishing_slip(walked, at);
  return change && exact_change(builder, walked.scene_at(at.at), *change, symmetric_scenes, beside_singular, tolerance);
}

}  // namespace clatter::branches
