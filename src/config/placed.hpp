#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/consistency.hpp"

namespace clatter::config {

/// A number of the scene at every point of a sweep, such as the place of a stop or the start.
struct Placed {
  std::string name;
  std::vector<double> values;
  const Setting* given = nullptr;        ///< nullptr: a default
  std::optional<std::size_t> dimension;  ///< along which it varies
};

[[nodiscard]] Placed placed(const Settings& settings, const AxisGroups& groups, Parameter parameter);

/// The lower (-1) or the upper (+1) one of two symmetric places, whose distance from the middle is `name`.
[[nodiscard]] Placed mirrored(Placed distance, double side, const std::string& name);

[[nodiscard]] inline bool is_below(double left, double right) { return left < right; }
[[nodiscard]] inline bool is_not_above(double left, double right) { return left <= right; }

/// Compares two numbers value by value if they vary together, else the largest value of the lower one with the smallest
/// of the higher. Throws ConfigError if that isn't permitted: "expected RULE".
void compare(const Placed& low, const Placed& high, bool (*permitted)(double, double), const std::string& rule);

/// What a value of a setting may be.
struct Condition {
  const Setting* given = nullptr;  ///< nullptr: it holds, since the key isn't given
  std::function<bool(double value)> holds;
};

/// A point of a sweep at which all of some conditions hold: for each of them the index of its setting's value. Nothing
/// if there is none, as where linked axes hold one condition at one point and another at the next.
[[nodiscard]] std::optional<std::vector<std::size_t>> point_with_all(const Settings& settings, const AxisGroups& groups,
                                                                     std::span<const Condition> conditions);

/// The place of a value of a setting for which a test holds, or nullptr.
template <class Test>
[[nodiscard]] const SourceLocation* place_of(const Setting* setting, const Test& test) {
  if (setting == nullptr) return nullptr;
  const auto values = setting->numbers();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (test(values[i])) return &setting->location_of(i);
  return nullptr;
}

/// The place of a value other than 0 of a setting, or nullptr.
[[nodiscard]] inline const SourceLocation* place_of_nonzero(const Setting* setting) {
  return place_of(setting, [](double value) { return value != 0; });
}

}  // namespace clatter::config
