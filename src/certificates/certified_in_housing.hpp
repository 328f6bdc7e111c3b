#pragma once

#include "certificates/certified_point.hpp"

namespace clatter::certificates {

/// States what is claimed of motion with a loose mass.
void certify_transient_in_housing(const point::Problem& problem, const point::PointResult& result,
                                  CertifiedPoint& point);
void certify_periodic_in_housing(const point::Problem& problem, const point::PointResult& result,
                                 CertifiedPoint& point);

}  // namespace clatter::certificates
