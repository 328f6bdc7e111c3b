#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "branches/equations/equations.hpp"

namespace clatter::branches {

/// The unknowns of an impact of a loose mass: its phase, z' before it, and place and velocity of the main mass.
inline constexpr std::size_t of_wall_impact = 4;

/// [row][column], of the four unknowns of an impact.
using Square4 = std::array<std::array<double, of_wall_impact>, of_wall_impact>;

/// One flight of a loose mass: how far its end is from the next impact (z less the wall, z', place and velocity of the
/// main mass), and the derivatives of that by the impacts that it begins and ends with, as they are kept.
struct HousingLink {
  std::array<double, of_wall_impact> residual{};
  Square4 by_begin{}, by_end{};
  std::array<std::array<double, 2>, of_wall_impact> by_axis{};  ///< in the user's units
};
[[nodiscard]] std::vector<HousingLink> housing_links(const FollowedScene& scene, const Orbit& orbit,
                                                     const std::vector<OrbitEquations::Axis>& axes);

/// The derivatives of left . J right, the equations' change in one direction: `right` is a change of all impacts, which
/// the last flight returns `multiplier` times as large.
struct HousingSlopes {
  std::vector<Square4::value_type> by_impact{};  ///< [impact]
  std::array<double, 2> by_axis{};               ///< in the user's units
};
[[nodiscard]] HousingSlopes housing_slopes(const FollowedScene& scene, const Orbit& orbit,
                                           const std::vector<OrbitEquations::Axis>& axes, const Vector& left,
                                           const Vector& right, int multiplier);

}  // namespace clatter::branches
