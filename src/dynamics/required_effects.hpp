#pragma once

#include <string>
#include <vector>

#include "dynamics/effects.hpp"
#include "dynamics/scene.hpp"

namespace clatter {

/// What a scene can meet, and the bounds that this rests on.
struct Requirements {
  Effects effects;          ///< the smallest set that reproduces the scene exactly
  double free_reach = 0.0;  ///< |x - load| never exceeds this while no stop interferes; inf: no bound
  double reach = 0.0;       ///< nor this, impacts included
  double lower_gap = 0.0;   ///< of the lower stop from the load's equilibrium, negative beyond it
  double upper_gap = 0.0;   ///< of the upper stop
};

/// What a scene requires, and the sharpest bounds for it. A stop is left out on a proof alone: a NaN, or a start that
/// isn't known yet, keeps it in.
[[nodiscard]] Requirements requirements_of(const Scene& scene);

/// The smallest set of effects that reproduces a scene exactly.
[[nodiscard]] Effects required_effects(const Scene& scene);

/// An effect, whether a scene calls for it, and why.
struct Reason {
  std::string effect;
  bool required = false;
  std::string why;  ///< e.g. "|x| <= 5.03 < 6 for all time: out of reach"
};

/// Every effect of a scene: damping, forcing, resonance, load, lower stop, upper stop, dissipation, chatter and rest.
[[nodiscard]] std::vector<Reason> reasons_of(const Scene& scene);

/// The stops that a motion of these effects can meet; the others as if there were none.
[[nodiscard]] Stops stops_in_reach(const Stops& stops, const Effects& effects);

}  // namespace clatter
