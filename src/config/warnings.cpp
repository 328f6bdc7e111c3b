#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>

#include "config/config.hpp"
#include "config/consistency.hpp"

namespace clatter::config {
namespace {

/// Whether a key chooses an observable, as those do that are off by default; the others say how to compute one, or need
/// one beside them.
bool is_observable(const Key& key) {
  const std::string_view header = "[observe]\n";
  const std::size_t at = key.beside.find(header);
  const bool needs_another = at != std::string_view::npos && at + header.size() < key.beside.size();
  return key.section == "observe" && !needs_another &&
         (key.fallback == "false" || (key.kind == Kind::integer && key.fallback == "0"));
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

/// Warns of a damping ratio of a machine's soft stop or wall that was hardly meant to be one, as a coefficient without
/// its unit.
void warn_of_great_ratios(const Settings& settings, std::vector<Warning>& warnings) {
  constexpr double greatest = 2;  // twice critical: R = 0.05 (eq. 55)
  if (!settings.is_si()) return;
  for (const Parameter damping : {Parameter("stop_damping"), Parameter("stop_damping_lower"),
                                  Parameter("stop_damping_upper"), Parameter("loose_wall_damping"),
                                  Parameter("loose_wall_damping_lower"), Parameter("loose_wall_damping_upper")}) {
    const Setting* const given = settings.given(damping);
    if (given == nullptr || given->quantity != Quantity::number) continue;
    const auto values = given->numbers();
    const auto found = std::ranges::find_if(values, [](double value) { return value > greatest; });
    if (found == values.end()) continue;
    const std::string number = number_text(*found);
    warnings.push_back({to_string(given->location_of(static_cast<std::size_t>(found - values.begin()))), "machine",
                        std::string(damping.key()) + " = " + number + " is the damping ratio, " + number +
                            " times critical; if the damping is meant, give its unit: \"" + number + " N s/m\""});
  }
}

/// The numbers that a setting holds, whatever its kind.
std::vector<double> numbers_of(const Setting& setting) {
  if (const auto* const interval = std::get_if<Interval>(&setting.value)) return {(*interval)[0], (*interval)[1]};
  if (!setting.is_axis() && !std::holds_alternative<double>(setting.value)) return {};
  return {setting.numbers().begin(), setting.numbers().end()};
}

/// Warns of an angle beyond a turn without unit, which were degrees in any drawing.
void warn_of_great_angles(const Settings& settings, std::vector<Warning>& warnings) {
  constexpr double turn = 2 * std::numbers::pi;
  for (const auto* const list : {&settings.values, &settings.axes})
    for (const Setting& setting : *list) {
      if (setting.quantity != Quantity::angle || !setting.is_plain) continue;
      const auto values = numbers_of(setting);
      const auto found = std::ranges::find_if(values, [](double value) { return std::abs(value) > turn; });
      if (found == values.end()) continue;
      const std::string number = number_text(*found);
      warnings.push_back({to_string(setting.location_of(static_cast<std::size_t>(found - values.begin()))),
                          setting.is_axis() ? "sweep" : std::string(setting.key->section),
                          std::string(setting.key->name) + " = " + number +
                              " is in rad, more than a turn; if degrees are meant, give the unit: \"" + number +
                              " deg\""});
    }
}

/// Warns of a value that counts for nothing, since [sweep] has an axis of its key.
void warn_of_surplus_values(const Settings& settings, std::vector<Warning>& warnings) {
  for (const Replaced& replaced : settings.replaced)
    if (replaced.is_surplus)
      warnings.push_back({to_string(replaced.former), std::string(settings.scene_section),
                          '\'' + std::string(replaced.key) + "' has no effect beside its axis in [sweep], " +
                              to_string(replaced.by) + "; leave one of them out"});
}

/// Warns of an axis of the file that the command line replaces by one value.
void warn_of_lost_axes(const Settings& settings, std::vector<Warning>& warnings) {
  for (const Replaced& replaced : settings.replaced)
    if (replaced.values > 1)
      warnings.push_back({to_string(replaced.by), "sweep",
                          "one value in place of the " + std::to_string(replaced.values) + " of '" +
                              std::string(replaced.key) + "' in [sweep], " + to_string(replaced.former)});
}

}  // namespace

std::vector<Warning> warnings_of(const Settings& settings, const AxisGroups& groups) {
  std::vector<Warning> warnings = keys_without_effect(settings);
  warn_of_repeats(settings, groups, warnings);
  warn_of_great_ratios(settings, warnings), warn_of_great_angles(settings, warnings);
  warn_of_lost_axes(settings, warnings), warn_of_surplus_values(settings, warnings);
  warn_of_nothing_observed(settings, warnings);
  return warnings;
}

}  // namespace clatter::config
