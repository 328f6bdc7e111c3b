#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

#include "config/config.hpp"
#include "config/consistency.hpp"

namespace clatter::config {
namespace {

/// Whether a key chooses an observable, as those do that are off by default; the others say how to compute one.
bool is_observable(const Key& key) {
  return key.section == "observe" && (key.fallback == "false" || (key.kind == Kind::integer && key.fallback == "0"));
}

/// Warns of a run that observes nothing, unless every observable is written as off, as by `clatter defaults`.
void warn_of_nothing_observed(const Settings& settings, std::vector<Warning>& warnings) {
  bool each_written = true;
  for (const Key& key : keys()) {
    if (!is_observable(key)) continue;
    const Setting* const given = settings.find(key.section, key.name);
    if (given != nullptr && given->value != default_setting(key).value) return;
    each_written = each_written && given != nullptr;
  }
  if (each_written) return;
  warnings.push_back({to_string(settings.location_of_section("observe")), "observe",
                      "nothing is observed: the file will hold only status, impacts and periods; write e.g. "
                      "extrema = true in [observe]"});
}

/// The index of the first value that repeats an earlier one; in the values of a function the two are neighbours.
std::optional<std::size_t> repeated(const AxisValues& axis) {
  const std::vector<double>& values = axis.values;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!axis.locations.empty()) std::ranges::stable_sort(order, {}, [&](std::size_t index) { return values[index]; });
  std::optional<std::size_t> first;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (values[order[i]] == values[order[i - 1]]) first = std::min(first.value_or(order[i]), order[i]);
  }
  return first;
}

/// Warns of a value twice on an axis that crosses others, which computes all its points twice; linked and followed axes
/// may well return to a value.
void warn_of_repeats(const Settings& settings, const AxisGroups& groups, std::vector<Warning>& warnings) {
  const auto followed = followed_dimension(settings, groups);
  for (std::size_t dimension = 0; dimension < groups.size(); ++dimension) {
    if (groups[dimension].size() > 1 || dimension == followed) continue;
    const Setting& setting = settings.axes[groups[dimension].front()];
    const auto index = repeated(std::get<AxisValues>(setting.value));
    if (!index) continue;
    warnings.push_back({to_string(setting.location_of(*index)), "sweep",
                        std::string(setting.key->name) + " = " + number_text(setting.numbers()[*index]) +
                            " again, which computes the same points twice; give each value once"});
  }
}

}  // namespace

std::vector<Warning> warnings_of(const Settings& settings, const AxisGroups& groups) {
  std::vector<Warning> warnings = keys_without_effect(settings);
  warn_of_repeats(settings, groups, warnings);
  warn_of_nothing_observed(settings, warnings);
  return warnings;
}

}  // namespace clatter::config
