#pragma once

#include <vector>

#include "branches/walk/special_kind.hpp"
#include "branches/walk/walk.hpp"
#include "observables/all.hpp"

namespace clatter::branches {

/// A point of a branch with one parameter that a sign has singled out.
struct FoundPoint {
  SpecialKind kind;
  CurvePoint point;
};

/// How a step lies on its branch.
struct StepEnds {
  bool begins_in_special = false;  ///< it is the first one from a special point
  bool begins_across = false;      ///< in which the branch runs across the parameter, or turns by rounding
  bool ends_in_graze = false;
};

/// The special points within a step of a walk, in the order of the branch: folds, flips or losses of symmetry, in a
/// housing Neimark-Sacker bifurcations, and maxima of the measures that are observed. Where a branch is born, and in a
/// graze, rounding decides how a measure changes: no maximum is told within a hundredth of a step of them.
[[nodiscard]] std::vector<FoundPoint> special_points_within(const OrbitEquations& equations, const Walk& walk,
                                                            double step, const StepEnds& ends,
                                                            const observables::Observe& observe);

}  // namespace clatter::branches
