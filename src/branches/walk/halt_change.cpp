#include "branches/walk/halt_change.hpp"

#include <cmath>

#include "branches/equations/flight.hpp"
#include "branches/equations/newton.hpp"

namespace clatter::branches {
namespace {

using Kind = Condition::Kind;

Condition level(Kind kind, std::size_t halt, Side side) {
  return {.kind = kind, .impact = halt, .without = {}, .side = side};
}

/// The side that the mass moved to before an event.
Side heading_before(const Orbit& orbit, std::size_t i) {
  if (i > 0) return orbit.impacts[i - 1].heading();
  const Side last = orbit.impacts.back().heading();
  return orbit.mirrored ? opposite(last) : last;
}

/// How long friction holds a mass where it halts, rad.
double held(const FollowedScene& scene, const OrbitImpact& halt, Side side) {
  return with_arcs(scene, [&]<Effects E>() {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    return flights.hold(halt.place, halt.phase, side);
  });
}

/// The velocity falls to 0 in a slip, which goes on at once: beyond, after a stick.
HaltChange grazing(const Orbit& orbit, const Violation& found, bool jumps) {
  const std::size_t halt = found.impact + 1;
  HaltChange change{SpecialKind::grazing_sliding, orbit.with(found.turning, halt),
                    level(Kind::level, halt, found.turning.side), HaltForm::none};
  if (!jumps) change.beyond = HaltForm::stick;
  return change;
}

/// A reversal comes to be a stick: a short one, or one that begins as the slip after it has become no more.
HaltChange sticking(const Orbit& orbit, const FollowedScene& scene, std::size_t i, bool jumps) {
  constexpr double is_short = 1.0;  // rad: else the force has passed the level before, and comes back a period later
  const OrbitImpact& halt = orbit.impacts[i];
  HaltChange change{SpecialKind::crossing_sliding, orbit.with_event(i, EventKind::stick),
                    level(Kind::level, i, halt.side), HaltForm::reversal, HaltForm::stick};
  if (held(scene, halt, halt.side) < is_short) return change;
  change.kind = SpecialKind::switching_sliding, change.before.reset();
  const std::size_t next = (i + 1) % orbit.size();
  if (next != 0 && orbit.impacts[next].event == EventKind::stick) {
    change.orbit.impacts[i].side = orbit.impacts[next].side;
    change.orbit = change.orbit.without(next);
  }
  if (jumps || next == 0) change.beyond.reset();
  return change;
}

/// A stick has become no more, or the other way is open sooner.
HaltChange slipping(const Orbit& orbit, const FollowedScene& scene, std::size_t i) {
  const OrbitImpact& halt = orbit.impacts[i];
  const Side other = opposite(halt.side);
  if (held(scene, halt, halt.side) < 0) {
    HaltChange change{SpecialKind::crossing_sliding, orbit, level(Kind::level, i, halt.side), HaltForm::stick,
                      HaltForm::reversal};
    if (heading_before(orbit, i) == halt.side)
      change.kind = SpecialKind::grazing_sliding, change.beyond = HaltForm::none;
    return change;
  }
  if (held(scene, halt, other) < 0)
    return {SpecialKind::switching_sliding, orbit, level(Kind::level, i, other), HaltForm::stick};
  return {SpecialKind::release_tangency, orbit, level(Kind::tangency, i, other), HaltForm::stick};
}

}  // namespace

Orbit formed(const Orbit& orbit, std::size_t halt, HaltForm form) {
  if (form == HaltForm::none) return orbit.without(halt);
  return orbit.with_event(halt, form == HaltForm::stick ? EventKind::stick : EventKind::reversal);
}

std::optional<ExactGraze> exact_change(const Equations& equations, const FollowedScene& near, const HaltChange& change,
                                       double within, double tolerance) {
  const OrbitEquations there = equations(change.orbit, {change.condition});
  const Vector guess = there.unknowns_of(near, change.orbit);
  const auto exact = solution(there, guess, tolerance);
  if (!exact || std::abs(exact->back() - guess.back()) > within) return std::nullopt;
  return ExactGraze{there.scene_at(*exact), there.orbit_at(*exact), change.condition.impact};
}

std::optional<HaltChange> halt_change(const OrbitEquations& equations, const Narrowed& found) {
  const FollowedScene scene = equations.scene_at(found.beyond.at);
  const Orbit orbit = equations.orbit_at(found.beyond.at);
  const std::size_t i = found.violated.impact;
  const bool jumps = scene.friction.static_level > scene.friction.kinetic;
  switch (found.violated.kind) {
    case Violation::Kind::halts:
      return grazing(orbit, found.violated, jumps);
    case Violation::Kind::sticks:
      return sticking(orbit, scene, i, jumps);
    case Violation::Kind::slips:
      return slipping(orbit, scene, i);
    case Violation::Kind::stays:
      return HaltChange{SpecialKind::release_tangency, orbit, level(Kind::tangency, i, orbit.impacts[i].side),
                        HaltForm::stick};
    default:
      return std::nullopt;
  }
}

}  // namespace clatter::branches
