#pragma once

#include "sweep/point.hpp"

namespace clatter {

/// Runs a point by the general method that its scene names.
[[nodiscard]] PointResult run_by_dormand_prince(const Scene& scene, Workshop& workshop);
[[nodiscard]] PointResult run_by_moreau(const Scene& scene, Workshop& workshop);

}  // namespace clatter
