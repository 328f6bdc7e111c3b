#pragma once

#include <limits>

#include "scene/effects.hpp"
#include "scene/scene.hpp"

namespace clatter {
inline namespace scene {

/// The effects that a scene can meet, and the bounds by which others are left out.
struct Requirements {
  Effects effects;          ///< the smallest set that reproduces the scene exactly
  double free_reach = 0.0;  ///< |x - load| never exceeds this while no stop interferes; inf: no bound
  double reach = 0.0;       ///< |x - load| never exceeds this, impacts included; inf: no bound
  double lower_gap = 0.0;   ///< from the lower stop to the load's equilibrium, negative if that is beyond the stop
  double upper_gap = 0.0;   ///< the same for the upper stop
};

/// The effects that a scene requires during a time in tau (inf: for all time), with the sharpest bounds. A stop is left
/// out only on a proof: a NaN, or a start that isn't known yet, keeps it in.
[[nodiscard]] Requirements requirements_of(const Scene& scene,
                                           double duration = std::numeric_limits<double>::infinity());

/// The smallest set of effects that reproduces a scene exactly during a time in tau.
[[nodiscard]] Effects required_effects(const Scene& scene, double duration = std::numeric_limits<double>::infinity());

/// The stops that a motion with these effects can meet; the others are at infinity.
[[nodiscard]] Stops stops_in_reach(const Stops& stops, const Effects& effects);

}  // namespace scene
}  // namespace clatter
