#include "config/placed.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::config {
namespace {

[[noreturn]] void refuse(const Placed& low, std::size_t i, const Placed& high, std::size_t j, const std::string& rule) {
  const bool is_start = high.name == "x0" || high.name == "loose_x0";
  const bool at_high = low.given == nullptr || (is_start && high.given != nullptr);
  const SourceLocation& location =
      at_high && high.given != nullptr ? high.given->location_of(j) : low.given->location_of(i);
  fail(location, low.name + " = " + number_text(low.values[i]) + " and " + high.name + " = " +
                     number_text(high.values[j]) + "; expected " + rule);
}

/// Whether a condition holds at an index of its dimension; a value that doesn't vary has one for all.
bool holds_at(const Condition& condition, std::size_t index) {
  if (condition.given == nullptr) return true;
  const auto values = condition.given->numbers();
  return condition.holds(values[values.size() == 1 ? 0 : index]);
}

}  // namespace

Placed placed(const Settings& settings, const AxisGroups& groups, Parameter parameter) {
  const Setting* const given = settings.given(parameter);
  const std::string name(parameter.key());
  if (given == nullptr) return {name, {settings.number(settings.scene_section, name)}, nullptr, std::nullopt};
  const auto numbers = given->numbers();
  return {name, {numbers.begin(), numbers.end()}, given, dimension_of(settings, given, groups)};
}

Placed mirrored(Placed distance, double side, const std::string& name) {
  for (double& value : distance.values) value = side * std::abs(value);
  distance.name = side < 0 ? '-' + name : name;
  return distance;
}

void compare(const Placed& low, const Placed& high, bool (*permitted)(double, double), const std::string& rule) {
  if (low.dimension && low.dimension == high.dimension) {
    for (std::size_t i = 0; i < low.values.size(); ++i) {
      if (!permitted(low.values[i], high.values[i])) refuse(low, i, high, i, rule);
    }
    return;
  }
  const auto i = std::max_element(low.values.begin(), low.values.end()) - low.values.begin();
  const auto j = std::min_element(high.values.begin(), high.values.end()) - high.values.begin();
  const auto low_index = static_cast<std::size_t>(i), high_index = static_cast<std::size_t>(j);
  if (!permitted(low.values[low_index], high.values[high_index])) refuse(low, low_index, high, high_index, rule);
}

std::optional<std::vector<std::size_t>> point_with_all(const Settings& settings, const AxisGroups& groups,
                                                       std::span<const Condition> conditions) {
  // dimensions vary independently, so that each of them may have an index of its own at which its conditions hold
  std::vector<std::size_t> point(conditions.size(), 0);
  std::vector<std::optional<std::size_t>> dimensions;
  for (const Condition& condition : conditions) dimensions.push_back(dimension_of(settings, condition.given, groups));
  for (std::size_t first = 0; first < conditions.size(); ++first) {
    const auto together = [&](std::size_t i) { return dimensions[i] == dimensions[first]; };
    const auto all_hold = [&](std::size_t index) {
      for (std::size_t i = 0; i < conditions.size(); ++i)
        if (together(i) && !holds_at(conditions[i], index)) return false;
      return true;
    };
    const std::size_t length = dimensions[first] ? conditions[first].given->numbers().size() : 1;
    std::size_t index = 0;
    while (index < length && !all_hold(index)) ++index;
    if (index == length) return std::nullopt;
    for (std::size_t i = first; i < conditions.size(); ++i)
      if (together(i)) point[i] = index;
  }
  return point;
}

}  // namespace clatter::config
