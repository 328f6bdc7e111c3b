#pragma once

#include <vector>

#include "branches/branch.hpp"
#include "branches/walk/walk.hpp"
#include "observables/all.hpp"

namespace clatter::branches {

/// A point of a branch with one parameter that a sign has singled out.
struct FoundPoint {
  SpecialKind kind;
  CurvePoint point;
};

/// The special points within a step of a walk, in the order of the branch: folds, flips or losses of symmetry, in
/// a housing Neimark-Sacker bifurcations, and
/// maxima of the measures that are observed. `is_first`: it is the first step from a special point.
[[nodiscard]] std::vector<FoundPoint> special_points_within(const OrbitEquations& equations, const Walk& walk,
                                                            double step, bool is_first,
                                                            const observables::Observe& observe);

}  // namespace clatter::branches
