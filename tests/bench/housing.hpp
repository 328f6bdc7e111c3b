#pragma once

#include <array>

#include "point/problem.hpp"

namespace clatter::bench {

/// Motion of a loose mass and the main mass at the end of a run.
struct InHousing {
  std::array<double, 4> state{};  ///< x, x', z, z'
  double impacts = 0.0;           ///< on walls
};

/// Boost.Odeint: Dormand and Prince's pair of orders 5 and 4, impacts on its dense output, for the time of a transient.
[[nodiscard]] InHousing odeint_in_housing(const point::Problem& scene, double tolerance);

}  // namespace clatter::bench
