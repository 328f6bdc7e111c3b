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
/// That within a step of a walk. Beside it one half less the other is a vector that grows with the distance from there,
/// and points the other way on the other side. The turn of the parameter, which also is there, has no digits beside it.
/// Nothing if the halves don't meet.
[[nodiscard]] std::optional<MetHalves> halves_met(const OrbitEquations& equations, const Walk& walk, double step,
                                                  bool symmetric_scene);

/// Whether the only turn of the parameter within a length of a walk is that where the halves meet: as long as there are
/// no digits beside that, it may be found in the step before.
[[nodiscard]] bool is_turn_of_birth(const OrbitEquations& equations, const Walk& walk, double length,
                                    bool symmetric_scene);

}  // namespace clatter::branches
