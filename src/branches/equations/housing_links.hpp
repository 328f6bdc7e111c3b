#pragma once

#include <array>
#include <complex>
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

/// Zero if a number, +1 or -1, is a multiplier of the orbit as it is kept, with its derivatives: the least singular
/// value of the equations of small changes that this number times as large return.
struct HousingMultiplier {
  double value = 0.0;
  std::vector<Square4::value_type> by_impact{};  ///< [impact]
  std::array<double, 2> by_axis{};               ///< in the user's units
};
/// `speed_unit`: of the unknowns that are no phases.
[[nodiscard]] HousingMultiplier housing_multiplier(const FollowedScene& scene, const Orbit& orbit,
                                                   const std::vector<OrbitEquations::Axis>& axes, int multiplier,
                                                   double speed_unit);

/// The derivative of the map of one impact on a wall to the same impact a period, or half a period, later.
struct HousingMap {
  Square4 map{};
  double denominator = 1.0;  ///< product of z' over nu at all impacts, without which the map is infinite in a graze
  double determinant = 1.0;  ///< of the map: e^(-2 h T) R^(2 n)

  /// Zero if the product of two multipliers is 1; finite in a graze.
  [[nodiscard]] double distance_to_unit_product() const;
  /// Whether two multipliers with such a product would be a complex pair.
  [[nodiscard]] bool would_be_complex() const;
  [[nodiscard]] std::array<std::complex<double>, 4> multipliers() const;  ///< the largest modulus first
};
/// Zero if `multiplier`, +1 or -1, is a multiplier of the orbit as it is kept; finite in a graze.
[[nodiscard]] double distance_to_in_housing(const FollowedScene& scene, const Orbit& orbit, int multiplier);

/// Of motion without impacts that of its state: the loose mass has two multipliers of 1.
[[nodiscard]] HousingMap housing_map(const FollowedScene& scene, const Orbit& orbit);

/// The unit direction from a flip, or a loss of symmetry, into the motion that is born there, as
/// `direction_of_daughter`.
[[nodiscard]] Vector direction_of_daughter_in_housing(const FollowedScene& scene, const Orbit& orbit,
                                                      const Orbit& daughter, double speed_unit);

}  // namespace clatter::branches
