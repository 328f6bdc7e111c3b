#pragma once

#include "point/point.hpp"

namespace clatter::point {

/// Runs a point by the general method that its scene names.
[[nodiscard]] PointResult run_by_dormand_prince(const Problem& scene, ThreadScratch& scratch);
[[nodiscard]] PointResult run_by_moreau(const Problem& scene, ThreadScratch& scratch);

}  // namespace clatter::point
