#pragma once

#include "branches/branch.hpp"
#include "branches/followed.hpp"
#include "certificates/certified_point.hpp"

namespace clatter::certificates {

/// States what is claimed of the motion at a point of a branch that begins with a problem.
[[nodiscard]] CertifiedPoint certified(const branches::BranchPoint& point, const point::Problem& start);

/// States what is claimed of a special point along a parameter.
[[nodiscard]] CertifiedPoint certified(const branches::SpecialPoint& special, const branches::Followed& along,
                                       const point::Problem& start);

}  // namespace clatter::certificates
