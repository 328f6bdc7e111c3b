#pragma once

#include "branches/waiting.hpp"
#include "branches/walk/halt_change.hpp"

namespace clatter::branches {

/// A branch near its end.
struct NearEnd {
  BranchPoint last;      ///< good
  FollowedScene beyond;  ///< near the end, or a little beyond it
  double within;         ///< that the end lies of it, over the width of the parameter's range
};

/// Ends a branch in the first change of its halts that is near; the motion beyond waits.
void end_in_change(const Equations& equations, double tolerance, const NearEnd& end,
                   const std::vector<HaltChange>& changes, Record& record, std::deque<Waiting>& waiting,
                   std::int64_t generation);

}  // namespace clatter::branches
