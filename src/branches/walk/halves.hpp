#pragma once

#include <optional>

#include "branches/walk/walk.hpp"

namespace clatter::branches {

/// A point of a branch at which its motion, over an even number of repetitions or without symmetry, is that of one half
/// twice, or of one half and its mirror image. There the branch was born on that motion.
struct MetHalves {
  CurvePoint point;
  Orbit half;
};
/// Where the halves meet within a step of a walk; nothing if they don't. One half less the other is a vector that grows
/// with the distance from there, and points the other way on the other side: it has digits where the turn of the
/// parameter, which is there, too, has none.
[[nodiscard]] std::optional<MetHalves> halves_met(const OrbitEquations& equations, const Walk& walk, double step,
                                                  bool symmetric_scene);

/// Whether the only turn of the parameter within a length of a walk is that where the halves meet: as long as there are
/// no digits beside that, it may be found in the step before.
[[nodiscard]] bool is_turn_of_birth(const OrbitEquations& equations, const Walk& walk, double length,
                                    bool symmetric_scene);

/// The half of free motion under dry friction that is its own mirror image. It may be in a scene that isn't, such as
/// one with a single stop out of reach, where it is kept as a whole. If its halts change, those of both halves do at
/// once, and the equations in which each may do so by itself are singular, or nearly. Nothing if it is no such motion.
[[nodiscard]] std::optional<Orbit> half_of_free_slips(const FollowedScene& scene, const Orbit& orbit);
/// A unit vector of changes of such a motion from that of its half, with one parameter.
[[nodiscard]] Vector along_both_halves(const Vector& along_half);

}  // namespace clatter::branches
