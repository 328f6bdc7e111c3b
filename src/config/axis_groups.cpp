#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "config/axis_functions.hpp"
#include "config/consistency.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"

namespace clatter::config {
namespace {

std::size_t axis_of(const Settings& settings, const Setting& setting, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Setting& axis : settings.axes) names.push_back(axis.key->name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string message = names_key(setting, name) + ", which is no axis of [sweep]";
  const auto replaced = std::ranges::find_if(settings.replaced, [&](const Replaced& one) { return one.key == name; });
  if (replaced != settings.replaced.end())
    fail(setting.location,
         message + " with " + to_string(replaced->by) + "; add --set sweep." + std::string(setting.key->name) + "=''");
  const std::string way_out = names.empty() ? "; [sweep] has no axes" : suggestion(name, names, "; the axes are: ");
  fail(setting.location, message + way_out);
}

std::string name_of(const Setting& setting) { return std::string(setting.key->name); }

/// The axes that a setting names; each may be named once.
std::vector<std::size_t> named_axes(const Settings& settings, const Setting* setting) {
  if (setting == nullptr || without_blanks(std::get<std::string>(setting->value)).empty()) return {};
  std::vector<std::size_t> axes;
  for (const std::string& name : split_names(std::get<std::string>(setting->value))) {
    const std::size_t axis = axis_of(settings, *setting, name);
    if (std::find(axes.begin(), axes.end(), axis) != axes.end())
      fail(setting->location, names_key(*setting, name) + " twice; name each axis once");
    axes.push_back(axis);
  }
  return axes;
}

std::vector<std::size_t> linked_axes(const Settings& settings) {
  const Setting* const setting = settings.find("sweep", "linked");
  const std::vector<std::size_t> linked = named_axes(settings, setting);
  if (linked.size() == 1) fail(setting->location, "linked names one axis; name at least two, e.g. \"nu, f\", or none");
  for (const std::size_t axis : linked) {
    const Setting& first = settings.axes[linked.front()];
    const Setting& other = settings.axes[axis];
    if (other.numbers().size() == first.numbers().size()) continue;
    fail(setting->location, "linked axes of different lengths: " + name_of(first) + " has " +
                                std::to_string(first.numbers().size()) + " values, " + name_of(other) + " has " +
                                std::to_string(other.numbers().size()) + "; give them equally many");
  }
  return linked;
}

/// Following along a start would label all points but the first with a coordinate that they don't start from, and
/// Sobol's sequence leaps from value to value.
void check_can_follow(const Settings& settings, const Setting& follow, const std::vector<std::size_t>& group) {
  for (const std::size_t axis : group) {
    const std::string_view name = settings.axes[axis].key->name;
    if (std::get<AxisValues>(settings.axes[axis].value).sobol)
      fail(follow.location, "follow along " + in_quotes(name) +
                                ", whose values sobol(...) leap to and fro; write linspace(a, b, n), or follow none");
    constexpr std::array<std::string_view, 6> of_start{"phase", "x0", "v0", "start_period", "loose_x0", "loose_v0"};
    if (std::ranges::find(of_start, name) == of_start.end()) continue;
    fail(follow.location, "follow along " + in_quotes(name) +
                              ", which only the first point would start from; follow another axis, or none");
  }
}

}  // namespace

std::vector<std::string> split_names(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    names.emplace_back(without_blanks(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return names;
}

void spread_sobol(Settings& settings) {
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < settings.axes.size(); ++axis)
    if (std::get<AxisValues>(settings.axes[axis].value).sobol) axes.push_back(axis);
  const auto fail_at = [&](std::size_t axis, const std::string& message) {
    fail(settings.axes[axis].location, name_of(settings.axes[axis]) + " = sobol(...)" + message);
  };
  if (axes.size() > 1) {
    const std::vector<std::size_t> linked = linked_axes(settings);
    std::string names;
    for (const std::size_t axis : axes) names.append(names.empty() ? "" : ", ").append(name_of(settings.axes[axis]));
    for (const std::size_t axis : axes)
      if (std::ranges::find(linked, axis) == linked.end())
        fail_at(axis, " without its partners, which would cross them; write linked = \"" + names + '"');
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    auto& axis = std::get<AxisValues>(settings.axes[axes[i]].value);
    const auto [a, b] = *axis.sobol;
    axis.values = sobol_values(a, b, axis.values.size(), i, axes.size());
    const Key& key = *settings.axes[axes[i]].key;
    for (const double value : axis.values)
      if (!contains(key.range, value)) fail_at(axes[i], " has " + number_text(value) + "; expected " + permitted(key));
  }
}

AxisGroups group_axes(const Settings& settings) {
  const std::vector<std::size_t> linked = linked_axes(settings);
  AxisGroups groups;
  double points = 1;
  for (std::size_t axis = 0; axis < settings.axes.size(); ++axis) {
    const bool is_linked = std::find(linked.begin(), linked.end(), axis) != linked.end();
    if (is_linked && axis != linked.front()) continue;  // the dimension stands in place of its first axis
    groups.push_back(is_linked ? linked : std::vector<std::size_t>{axis});
    points *= static_cast<double>(settings.axes[axis].numbers().size());
    if (points > max_points)
      fail(settings.axes[axis].location,
           "a sweep of " + number_text(points) + " points; expected at most " + number_text(max_points));
  }
  return groups;
}

std::optional<std::size_t> followed_dimension(const Settings& settings, const AxisGroups& groups) {
  const Setting* const setting = settings.find("sweep", "follow");
  const std::vector<std::size_t> axes = named_axes(settings, setting);
  if (axes.empty()) return std::nullopt;
  const auto holds = [](const auto& group, std::size_t axis) {
    return std::find(group.begin(), group.end(), axis) != group.end();
  };
  const auto followed =
      std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return holds(group, axes.front()); });
  for (const std::size_t axis : axes) {
    if (holds(*followed, axis)) continue;
    fail(setting->location, "follow names " + in_quotes(name_of(settings.axes[axes.front()])) + " and " +
                                in_quotes(name_of(settings.axes[axis])) +
                                ", which are not linked; follow one axis, or name both in linked too");
  }
  check_can_follow(settings, *setting, *followed);
  return static_cast<std::size_t>(followed - groups.begin());
}

std::optional<std::size_t> dimension_of(const Settings& settings, const Setting* given, const AxisGroups& groups) {
  for (std::size_t dimension = 0; dimension < groups.size(); ++dimension)
    for (const std::size_t axis : groups[dimension])
      if (&settings.axes[axis] == given) return dimension;
  return std::nullopt;
}

}  // namespace clatter::config
