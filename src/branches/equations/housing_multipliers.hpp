#pragma once

#include <array>
#include <complex>
#include <vector>

#include "branches/equations/housing_links.hpp"

namespace clatter::branches {

/// Zero if a number, +1 or -1, is a multiplier of the orbit as it is kept, with its derivatives: the least singular
/// value of the equations of small changes that this number times as large return.
struct HousingMultiplier {
  double value = 0.0;
  HousingSlopes slopes{};
};
/// `speed_unit`: of the unknowns that are no phases.
[[nodiscard]] HousingMultiplier housing_multiplier(const FollowedScene& scene, const Orbit& orbit,
                                                   const std::vector<OrbitEquations::Axis>& axes, int multiplier,
                                                   double speed_unit);

/// The characteristic polynomial of the map from one event to the same one a period, or half a period, later:
/// `leading` times s^4 - a s^3 + b s^2 - c s + D. All but D are multiplied by `leading`, which is 0 in a graze.
struct HousingCharacteristic {
  double leading = 1.0, a = 0.0, b = 0.0, c = 0.0;
  double determinant = 1.0;  ///< D, the product of the multipliers, as `ImpactMap` has it

  /// Its value at +1 or -1: zero if that is a multiplier.
  [[nodiscard]] double at(int multiplier) const { return leading * (1 + determinant) + b - multiplier * (a + c); }
  /// Zero if the product of two multipliers is 1.
  [[nodiscard]] double distance_to_unit_product() const;
  /// Whether two multipliers with such a product would be a complex pair.
  [[nodiscard]] bool would_be_complex() const { return beyond_real() > 0; }
  /// Positive if they would be; zero if both would be 1, or -1.
  [[nodiscard]] double beyond_real() const;
};
[[nodiscard]] HousingCharacteristic housing_characteristic(const FollowedScene& scene, const Orbit& orbit);

/// The multipliers of the orbit as it is kept, the largest modulus first; NaN in a graze, and beside one so large that
/// others have no digits. Of motion that meets no wall two are 1, those of the loose mass.
[[nodiscard]] std::array<std::complex<double>, 4> housing_multipliers(const FollowedScene& scene, const Orbit& orbit);

/// The unit direction from a flip, or a loss of symmetry, into the motion that is born there, as
/// `direction_of_daughter`.
[[nodiscard]] Vector direction_of_daughter_in_housing(const FollowedScene& scene, const Orbit& orbit,
                                                      const Orbit& daughter, double speed_unit);

}  // namespace clatter::branches
