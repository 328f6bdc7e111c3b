#include <algorithm>
#include <cmath>
#include <string>

#include "config/consistency.hpp"

namespace clatter::config {
namespace {

using enum sweep::Parameter;

/// A place on the x axis at every point of the sweep: a stop or the start.
struct Quantity {
  std::string name;
  std::vector<double> values;
  std::optional<Given> given;            ///< empty: a default
  std::optional<std::size_t> dimension;  ///< along which it varies
};

std::optional<std::size_t> dimension_of(const Given& given, const AxisGroups& groups) {
  for (std::size_t dimension = 0; given.axis && dimension < groups.size(); ++dimension) {
    const auto& group = groups[dimension];
    if (std::find(group.begin(), group.end(), *given.axis) != group.end()) return dimension;
  }
  return std::nullopt;
}

Quantity quantity(const Settings& settings, const AxisGroups& groups, sweep::Parameter parameter) {
  const auto given = settings.given(parameter);
  if (!given)
    return {std::string(key_of(parameter)), {settings.number("scene", key_of(parameter))}, std::nullopt, std::nullopt};
  return {std::string(key_of(parameter)),
          {given->values.begin(), given->values.end()},
          given,
          dimension_of(*given, groups)};
}

/// The lower (-1) or the upper (+1) of symmetric stops.
Quantity symmetric_stop(const Settings& settings, const AxisGroups& groups, double side) {
  Quantity stop = quantity(settings, groups, xs);
  for (double& value : stop.values) value = side * std::abs(value);
  stop.name = side < 0 ? "-|xs|" : "|xs|";
  return stop;
}

using Permitted = bool (*)(double, double);

[[noreturn]] void refuse(const Quantity& low, std::size_t i, const Quantity& high, std::size_t j,
                         const std::string& rule) {
  const bool at_high = !low.given || (high.name == "x0" && high.given);
  const SourceLocation& location = at_high ? high.given->location_of(j) : low.given->location_of(i);
  fail(location, low.name + " = " + number_text(low.values[i]) + " and " + high.name + " = " +
                     number_text(high.values[j]) + "; permitted: " + rule);
}

/// Two quantities that vary together are compared value by value, else the largest of the lower with the smallest of
/// the higher.
void compare(const Quantity& low, const Quantity& high, Permitted permitted, const std::string& rule) {
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

}  // namespace

void check_stops_and_start(const Settings& settings, const AxisGroups& groups) {
  const bool symmetric = settings.given(xs).has_value();
  Quantity lower = symmetric ? symmetric_stop(settings, groups, -1) : quantity(settings, groups, stop_lower);
  Quantity upper = symmetric ? symmetric_stop(settings, groups, 1) : quantity(settings, groups, stop_upper);
  const Permitted below = [](double left, double right) { return left < right; };
  const Permitted not_above = [](double left, double right) { return left <= right; };
  if (!symmetric) compare(lower, upper, below, "stop_lower < stop_upper");
  if (settings.given(start_period)) return;  // it starts on the lower stop
  // along `follow` only the first point starts from [scene]; later ones move onto a stop that has come past them
  const auto followed = followed_dimension(settings, groups);
  const auto at_start = [&](Quantity quantity) {
    if (followed && quantity.dimension == followed) quantity.values.resize(1);
    return quantity;
  };
  lower = at_start(lower), upper = at_start(upper);
  const Quantity start = at_start(quantity(settings, groups, x0));
  const std::string rule = "a start between the stops, " + lower.name + " <= x0 <= " + upper.name;
  compare(lower, start, not_above, rule);
  compare(start, upper, not_above, rule);
}

}  // namespace clatter::config
