#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clatter::config {

/// A function that makes the values of an axis from three numbers.
struct AxisFunction {
  std::string_view name;
  std::string_view usage;  ///< "linspace(a, b, n)"
  bool counts;             ///< the third number is one of values
  /// Fills `values`; returns a fault of the arguments, or nothing.
  std::string (*evaluate)(const std::array<double, 3>& arguments, std::vector<double>& values);
};

[[nodiscard]] std::optional<AxisFunction> axis_function(std::string_view name);

inline constexpr std::string_view sobol_name = "sobol";

/// The values of one dimension of Sobol's sequence, from its first point on, which has u = 1/2 in each: a + (b - a) u.
/// The points fill all dimensions together evenly.
[[nodiscard]] std::vector<double> sobol_values(double a, double b, std::size_t n, std::size_t dimension,
                                               std::size_t dimensions);

[[nodiscard]] std::span<const std::string_view> axis_function_names();

}  // namespace clatter::config
