#pragma once

#include <cstddef>
#include <optional>

#include "branches/walk/graze.hpp"
#include "branches/walk/violation.hpp"
#include "branches/walk/walk.hpp"

namespace clatter::branches {

/// The first violation within a step of a walk.
struct Narrowed {
  CurvePoint last_good;  ///< before it
  CurvePoint beyond;     ///< a little after it
  Violation violated;
};
/// By bisection; nothing if motion between the stops can be followed as far as that.
[[nodiscard]] std::optional<Narrowed> narrowed(const OrbitEquations& equations, const Walk& walk, double step);

/// The motion with a graze that ends a branch, or a curve: near it, to be made exact by equations. At a soft stop a
/// contact, or an interruption of one, appears or vanishes: beginning and end of it are one event in the graze, which
/// changes nothing. Or the mass, in contact again beyond the stop's position, just comes back to that first.
struct Touch {
  CurvePoint last_good;                   ///< before the graze, of which the proof of first contact holds
  CurvePoint beyond;                      ///< of that motion a little beyond the graze
  Orbit orbit;                            ///< with the event that grazes
  std::size_t event = 0;                  ///< its number
  bool appears = false;                   ///< beyond the graze there is one event more; else one less
  std::optional<std::size_t> vanishes{};  ///< the event of the walked motion that the contact that vanishes begins with
  bool turns = false;  ///< or none more nor less: a renewal turns into a touch, or the other way round
  bool halts = false;  ///< under dry friction: without the impact the mass halts there

  [[nodiscard]] Graze graze() const;
};

/// A motion with a graze in place of the contact, or of the interruption of one, that begins with event `first`.
[[nodiscard]] Orbit with_graze(Orbit orbit, std::size_t first);

/// The graze of a violation.
[[nodiscard]] Touch touch_of(const OrbitEquations& equations, const Narrowed& found);
/// The graze within a step of a walk; nothing if motion between the stops can be followed as far as that.
[[nodiscard]] std::optional<Touch> touch_within(const OrbitEquations& equations, const Walk& walk, double step);

/// Motion under dry friction that halts on the position of a rigid stop and turns there, with the impact that is about
/// to begin there; any other motion as it is.
[[nodiscard]] Orbit with_impact_at_graze(const FollowedScene& scene, const Orbit& orbit,
                                         std::optional<std::size_t> graze);

/// The motion that halts in place of an impact without speed.
[[nodiscard]] Orbit halting_at_stop(const FollowedScene& scene, Orbit orbit, std::size_t event);

}  // namespace clatter::branches
