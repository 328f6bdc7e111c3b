#pragma once

#include "point/point.hpp"

namespace clatter::point {

/// Runs a point by dopri5 or moreau; these are compiled apart from the exact method.
[[nodiscard]] PointResult run_by_dormand_prince(const Problem& problem, ThreadScratch& scratch);
[[nodiscard]] PointResult run_by_moreau(const Problem& problem, ThreadScratch& scratch);

}  // namespace clatter::point
