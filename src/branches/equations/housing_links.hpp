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

/// The characteristic polynomial of the map from one impact on a wall to the same impact a period, or half a period,
/// later: `leading` times s^4 - a s^3 + b s^2 - c s + D. All but D are multiplied by `leading`, which is 0 in a graze.
struct HousingCharacteristic {
  double leading = 1.0, a = 0.0, b = 0.0, c = 0.0;
  double determinant = 1.0;  ///< D, the product of the multipliers: e^(-2 h T) R^(2 n)

  /// Its value at +1 or -1: zero if that is a multiplier.
  [[nodiscard]] double at(int multiplier) const { return leading * (1 + determinant) + b - multiplier * (a + c); }
  /// Zero if the product of two multipliers is 1.
  [[nodiscard]] double distance_to_unit_product() const;
  /// Whether two multipliers with such a product would be a complex pair.
  [[nodiscard]] bool would_be_complex() const;
};
[[nodiscard]] HousingCharacteristic housing_characteristic(const FollowedScene& scene, const Orbit& orbit);

/// The multipliers of the orbit as it is kept, the largest modulus first; NaN in a graze. Of motion without impacts two
/// are 1, those of the loose mass.
[[nodiscard]] std::array<std::complex<double>, 4> housing_multipliers(const FollowedScene& scene, const Orbit& orbit);

/// The unit direction from a flip, or a loss of symmetry, into the motion that is born there, as
/// `direction_of_daughter`.
[[nodiscard]] Vector direction_of_daughter_in_housing(const FollowedScene& scene, const Orbit& orbit,
                                                      const Orbit& daughter, double speed_unit);

}  // namespace clatter::branches
