#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "branches/equations/equations.hpp"

namespace clatter::branches {

/// A motion with an event that grazes by a condition.
struct Graze {
  Orbit orbit;
  std::size_t impact = 0;
  Condition condition;
};

/// The equations of an orbit with conditions.
using Equations = std::function<OrbitEquations(const Orbit&, std::vector<Condition>)>;

/// The scene and the motion of a graze.
struct ExactGraze {
  FollowedScene scene;
  Orbit orbit;
  std::size_t impact = 0;
  bool joins =
      false;  ///< several grazes of soft stops at once are one of a motion that repeats sooner, or is symmetric
};
/// That near a guess, at a parameter within a distance of it, over the width of the range; nothing if there is none. A
/// contact with a soft stop that begins with less than `slow` may graze, too.
[[nodiscard]] std::optional<ExactGraze> exact_graze(const Equations& equations, const FollowedScene& near, Graze graze,
                                                    double slow, bool symmetric_scene, double within, double tolerance);

/// Of some directions from a point on, the first in which there is motion between the stops.
[[nodiscard]] std::optional<Vector> direction_into_motion(const OrbitEquations& equations, const Vector& from,
                                                          const std::vector<Vector>& directions, double tolerance);

/// A motion with one contact with a soft stop, or one interruption of a contact, more than a graze, where that is
/// short; or under dry friction with one impact, and a short rebound, before a stick on a stop. It begins with the
/// event that has the number of the graze, or of the stick. Nothing if there is none.
struct Opened {
  Orbit orbit;
  Vector at, tangent;  ///< of the equations with one parameter, towards longer ones
};
[[nodiscard]] std::optional<Opened> opened(const Equations& equations, const FollowedScene& scene, const Orbit& orbit,
                                           std::size_t graze, double tolerance);

/// The same with a renewal as a touch, or a touch as a renewal.
[[nodiscard]] Orbit turned(Orbit orbit, std::size_t event);

}  // namespace clatter::branches
