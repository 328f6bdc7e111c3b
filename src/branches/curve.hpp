#pragma once

#include "branches/branch.hpp"

namespace clatter::branches {

/// Follows special points of one kind (`settings.curve`) in two parameters: first the branches along one of them, then
/// from each such point on them its curve, both ways. Points of the result are those of the curves, numbered as
/// branches are. Throws StartError if there is no such point.
[[nodiscard]] Branches follow_curves(const StartProblem& problem, const BranchSettings& settings);

}  // namespace clatter::branches
