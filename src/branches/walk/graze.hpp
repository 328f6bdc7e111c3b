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
  std::size_t event = 0;
  Condition condition;
};

/// The equations of an orbit with conditions.
using Equations = std::function<OrbitEquations(const Orbit&, std::vector<Condition>)>;

/// The scene and the motion of a graze.
struct ExactGraze {
  FollowedScene scene;
  Orbit orbit;
  std::size_t event = 0;
  /// Whether several grazes of soft stops at once are one of a motion that repeats sooner, or is symmetric.
  bool joins = false;
};
/// The graze near a guess, at a parameter within a distance of it, over the width of the range; nothing if there is
/// none. A contact with a soft stop that begins with less speed than `slow` may graze, too.
[[nodiscard]] std::optional<ExactGraze> exact_graze(const Equations& equations, const FollowedScene& near, Graze graze,
                                                    double slow, bool symmetric_scene, double within, double tolerance);

/// Of some directions from a point on, the first in which there is motion between the stops.
[[nodiscard]] std::optional<Vector> direction_into_motion(const OrbitEquations& equations, const Vector& from,
                                                          const std::vector<Vector>& directions, double tolerance);

/// An orbit with a renewal as a touch, or a touch as a renewal.
[[nodiscard]] Orbit turned(Orbit orbit, std::size_t event);

}  // namespace clatter::branches
