#pragma once

#include <numbers>
#include <string>
#include <string_view>

#include "scene/quantity.hpp"

namespace clatter {
inline namespace scene {

/// The units that a problem is computed in, in those of the user; displacements keep their unit. A scene with k = 1 is
/// computed as it is.
template <class Number>
struct BasicUnits {
  Number time{1.0};       ///< one unit of computed time: s of a machine, > 0
  Number mass{1.0};       ///< the mass: kg of a machine, > 0
  Number stiffness{1.0};  ///< stiffness that is computed as 1: N/m of a machine, > 0
  bool is_si = false;     ///< the user's units are those of the SI, frequencies in cycles

  friend constexpr bool operator==(const BasicUnits&, const BasicUnits&) = default;
};
using Units = BasicUnits<double>;

namespace detail {

[[nodiscard]] constexpr double power(double base, int exponent) {
  double product = 1.0;
  for (int i = 0; i < (exponent < 0 ? -exponent : exponent); ++i) product *= base;
  return exponent < 0 ? 1.0 / product : product;
}

}  // namespace detail

/// The factor from a computed number to the user's; 1 if both are the same.
[[nodiscard]] constexpr double factor_of(const Units& units, Quantity quantity) {
  const Exponents exponents = exponents_of(quantity);
  const double factor = detail::power(units.time, exponents.time) * detail::power(units.mass, exponents.mass);
  return units.is_si && quantity == Quantity::frequency ? factor / (2 * std::numbers::pi) : factor;
}

/// The `units` attribute of a quantity: without SI every unit is that of the scene itself, but angles are in rad.
[[nodiscard]] constexpr std::string_view unit_of(Quantity quantity, bool is_si) {
  return is_si || quantity == Quantity::angle ? si_unit(quantity) : si_unit(Quantity::number);
}

/// The same of a derivative: "m s-1/(N m-1)".
[[nodiscard]] inline std::string unit_of_derivative(Quantity quantity, Quantity by, bool is_si) {
  const std::string unit(unit_of(quantity, is_si)), per(unit_of(by, is_si));
  if (per == "1") return unit;
  return unit == per ? "1" : unit + (per.find(' ') == std::string::npos ? '/' + per : "/(" + per + ')');
}

}  // namespace scene
}  // namespace clatter
