#pragma once

#include "point/problem.hpp"

namespace clatter::branches {

/// The paper's scene with bumpers in place of rigid stops.
inline point::Problem bumpers(double kappa, double zeta) {
  point::Problem problem;
  problem.oscillator = {0.1, -1.0, 1.1, 0.0};
  problem.stops = {-3.0, 3.0};
  problem.stops.stiffness_lower = problem.stops.stiffness_upper = kappa;
  problem.stops.damping_lower = problem.stops.damping_upper = zeta;
  problem.start = {2.0, 3.0, 0.0};
  return problem;
}

}  // namespace clatter::branches
