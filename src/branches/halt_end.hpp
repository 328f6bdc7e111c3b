#pragma once

#include "branches/waiting.hpp"
#include "branches/walk/halt_change.hpp"

namespace clatter::branches {

/// How a branch under dry friction ends, at its exact place: in a change of halts, or in the graze of a violation.
struct FrictionEnd {
  ExactGraze exact;
  std::optional<HaltChange> change{};  ///< nothing: a graze
  Violation graze{};
};
/// What is nearest to where a branch was found to end, if anything is within a distance of that over the width of the
/// parameter's range: next to one of them rounding decides which violations are found, and in which order. In a step
/// the parameter changes by its length at most, so that is the distance. Beside an end without derivatives steps shrink
/// before they come to it, so 1/100 of the largest one is, too, if the step is shorter.
[[nodiscard]] std::optional<FrictionEnd> nearest_end(const Equations& builder, const OrbitEquations& walked,
                                                     const Narrowed& between, bool symmetric_scenes, double within,
                                                     double tolerance);

/// Ends a branch in a change of its halts, after its last good point; the motion beyond waits.
void end_in_change(const FrictionEnd& end, const BranchPoint& last_good, Record& record, std::deque<Waiting>& waiting,
                   std::int64_t generation);

}  // namespace clatter::branches
