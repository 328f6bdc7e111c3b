#pragma once

#include "branches/branch.hpp"
#include "branches/equations/followed_scene.hpp"
#include "certificates/certified_point.hpp"

namespace clatter::certificates {

/// States what is claimed of the motion at a point of a branch that begins with a problem.
[[nodiscard]] CertifiedPoint certified(const branches::BranchPoint& point, const branches::StartProblem& start);

/// States what is claimed of a special point along a parameter.
[[nodiscard]] CertifiedPoint certified(const branches::SpecialPoint& special, Parameter along,
                                       const branches::StartProblem& start);

}  // namespace clatter::certificates
