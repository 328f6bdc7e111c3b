#pragma once

#include <array>
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
  /// Fills `values`; returns a fault of the arguments, or nothing.
  std::string (*evaluate)(const std::array<double, 3>& arguments, std::vector<double>& values);
};

[[nodiscard]] std::optional<AxisFunction> axis_function(std::string_view name);

[[nodiscard]] std::span<const std::string_view> axis_function_names();

}  // namespace clatter::config
