#pragma once

#include <optional>

#include "branches/walk/graze.hpp"

namespace clatter::branches {

/// A crest of the push to a side: its phase, the push there, and by how much it falls with half of the square of the
/// phase.
struct Crest {
  double phase, height, bend;
};
/// The one after a halt that may let the mass go to a side: of several the one that is most nearly as strong as the
/// level.
[[nodiscard]] Crest crest_after(const SceneNumbers<double>& p, const OrbitEvent& halt, Side side);

/// The phase nearest to another one at which the push to a side falls through a level; of a push that doesn't come as
/// far its crest.
[[nodiscard]] double fall_near(const SceneNumbers<double>& p, Side side, double phase, double level);

/// Where friction comes up to the force, so that it holds the mass at rest for good: the limit of motion whose slips,
/// all of them to sticks, vanish. Its sticks are those of the orbit near it, each from the crest of the push to one
/// side to that of the push to the other. Nothing if that isn't within a distance of a scene, over the unit of the
/// parameter.
[[nodiscard]] std::optional<ExactGraze> where_motion_ceases(const OrbitEquations& equations, FollowedScene near,
                                                            const Orbit& orbit, double within);

}  // namespace clatter::branches
