#pragma once

#include <optional>

#include "branches/walk/graze.hpp"

namespace clatter::branches {

/// The phase near another one at which the force pushes the most to a side.
[[nodiscard]] double crest_near(const SceneNumbers<double>& p, Side side, double phase);

/// Where friction comes up to the force, so that it holds the mass at rest for good: the limit of motion whose slips,
/// all of them to sticks, vanish. Its sticks are those of the orbit near it, each from the crest of the push to one
/// side to that of the push to the other. Nothing if that isn't within a distance of a scene, over the unit of the
/// parameter.
[[nodiscard]] std::optional<ExactGraze> where_motion_ceases(const OrbitEquations& equations, FollowedScene near,
                                                            const Orbit& orbit, double within);

}  // namespace clatter::branches
