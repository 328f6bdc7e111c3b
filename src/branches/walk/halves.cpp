#include "branches/walk/halves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace clatter::branches {
namespace {

/// The first half of an orbit, as the motion that it would be by itself; nothing if it can't be one.
std::optional<Orbit> first_half(const Orbit& orbit, bool symmetric_scene) {
  const std::size_t size = orbit.size() / 2;
  if (size == 0 || orbit.size() % 2 != 0 || orbit.mirrored || orbit.half_turns % 2 != 0) return std::nullopt;
  const int half_turns = orbit.half_turns / 2;
  Orbit half{{orbit.events.begin(), orbit.events.begin() + static_cast<std::ptrdiff_t>(size)},
             half_turns,
             half_turns % 2 != 0};
  if (half.mirrored && !symmetric_scene) return std::nullopt;
  for (std::size_t i = 0; i < size; ++i) {
    const OrbitEvent one = half.event(size + i), &other = orbit.events[size + i];
    if (one.kind != other.kind || one.side != other.side) return std::nullopt;
  }
  return half;
}

/// The second half as the first one would have it, less as it is: phases, and what is known of each event beside them,
/// with speeds in a unit.
Vector first_less_second(const Orbit& orbit, const Orbit& half, double speed_unit) {
  Vector off;
  for (std::size_t i = half.size(); i < orbit.size(); ++i) {
    const OrbitEvent one = half.event(i), &other = orbit.events[i];
    off.insert(off.end(), {one.phase - other.phase, (one.before - other.before) / speed_unit,
                           (one.place - other.place) / speed_unit, (one.other.place - other.other.place) / speed_unit,
                           (one.other.before - other.other.before) / speed_unit});
  }
  return off;
}

/// The motion in the middle between both halves of an orbit.
Orbit middle_of(Orbit half, const Orbit& orbit) {
  const Orbit first = half;
  for (std::size_t i = 0; i < half.size(); ++i) {
    const OrbitEvent one = first.event(half.size() + i), &other = orbit.events[half.size() + i];
    const double sign = half.mirrored ? -1 : 1;
    OrbitEvent& event = half.events[i];
    event.phase += (other.phase - one.phase) / 2;
    event.before += sign * (other.before - one.before) / 2;
    event.place += sign * (other.place - one.place) / 2;
    event.other.place += sign * (other.other.place - one.other.place) / 2;
    event.other.before += sign * (other.other.before - one.other.before) / 2;
  }
  return half;
}

}  // namespace

bool is_turn_of_birth(const OrbitEquations& equations, const Walk& walk, double length, bool symmetric_scene) {
  const auto end = walk.after(length);
  return end && walk.here().tangent.back() * end->tangent.back() < 0 &&
         halves_met(equations, walk, length, symmetric_scene);
}

std::optional<MetHalves> halves_met(const OrbitEquations& equations, const Walk& walk, double step,
                                    bool symmetric_scene) {
  if (!first_half(equations.shape(), symmetric_scene)) return std::nullopt;
  const auto off_at = [&](const CurvePoint& point) {
    const Orbit orbit = equations.orbit_at(point.at);
    return first_less_second(orbit, *first_half(orbit, symmetric_scene), equations.speed_unit());
  };
  const auto there = walk.after(step);
  if (!there) return std::nullopt;
  const Vector here = off_at(walk.here()), change = sum(off_at(*there), -1.0, here);
  const auto along_here = [&](const CurvePoint& point) { return product(here, off_at(point)); };
  // where they meet the branch runs across the parameter, and each half as far as the other one against it: for the
  // length s of a step, the difference by the root of 2 times s. That of motion whose halves are one is rounding.
  if (!(along_here(*there) < 0 && product(change, change) >= step * step)) return std::nullopt;
  auto zero = walk.zero(along_here, step);
  if (!zero) return std::nullopt;
  const Orbit orbit = equations.orbit_at(zero->at);
  return MetHalves{*std::move(zero), middle_of(*first_half(orbit, symmetric_scene), orbit)};
}

std::optional<Orbit> half_of_free_slips(const FollowedScene& scene, const Orbit& orbit) {
  constexpr double same = 1e-6;
  const bool may_mirror = scene.oscillator.stiffness != 0 && is_odd_by_half(scene.oscillator.shape);
  const Orbit half = orbit.half_if_same(same, may_mirror);
  if (orbit.mirrored || !half.mirrored || 2 * half.size() != orbit.size()) return std::nullopt;
  if (half.size() == 0 || !half.is_of_free_halts()) return std::nullopt;
  return half;
}

Vector along_both_halves(const Vector& along_half) {
  Vector both(along_half.begin(), along_half.end() - 1);
  const std::size_t size = both.size();
  for (std::size_t i = 0; i < size; ++i) both.push_back(i % 2 == 0 ? along_half[i] : -along_half[i]);
  both.push_back(along_half.back());
  const double length = std::sqrt(product(both, both));
  for (double& x : both) x /= length;
  return both;
}

}  // namespace clatter::branches
