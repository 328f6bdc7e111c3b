// The grammar of values: numbers and axes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "config/config.hpp"
#include "config/value_grammar.hpp"
#include "finding.hpp"

namespace clatter::fuzz {
namespace {

config::SourceText source(std::string_view text, Quantity quantity = Quantity::number) {
  return {text, {"input", 1, 1}, true, quantity};
}

bool same_bits(double left, double right) {
  return std::bit_cast<std::uint64_t>(left) == std::bit_cast<std::uint64_t>(right) ||
         (std::isnan(left) && std::isnan(right));  // all NaNs have the same text
}

void check_number(std::string_view text, Quantity quantity) {
  const double value = parse_number(source(text, quantity));
  for (const std::string& again : {config::number_text(value), config::toml_number(value)})
    require(same_bits(parse_number(source(again)), value), again + " is another number than it was made from");
}

/// Values between two ends, apart from rounding.
void require_between(std::span<const double> values, double one, double other) {
  const double slack = 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(one), std::abs(other)) +
                       std::numeric_limits<double>::denorm_min();
  const double least = std::min(one, other) - slack, most = std::max(one, other) + slack;
  for (const double value : values)
    if (!(value >= least && value <= most)) require(false, "a value beyond the ends: " + config::number_text(value));
}

/// Checks the values of a function by its own text: "linspace(a, b, n)".
void check_function(const config::AxisValues& axis) {
  const std::string_view call = std::string_view(axis.text).substr(1, axis.text.size() - 2);
  std::array<double, 3> arguments{};
  std::size_t begin = call.find('(') + 1;
  for (double& argument : arguments) {
    const std::size_t end = call.find_first_of(",)", begin);
    argument = parse_number(source(call.substr(begin, end - begin)));
    begin = end + 1;
  }
  const auto [a, b, last] = arguments;
  require(axis.locations.empty(), "positions of values that were not written one by one");
  const bool has_ends = !call.starts_with("sobol");
  require(!has_ends || same_bits(axis.values.front(), a), "an axis that doesn't begin with a");
  require_between(axis.values, a, b);
  if (call.starts_with("arange")) {
    const double steps = (b - a) / last;
    require(std::abs(static_cast<double>(axis.values.size()) - steps) <= 1 + 1e-9 * steps, "not as many steps as fit");
  } else {
    require(static_cast<double>(axis.values.size()) == last, "not n values");
    require(!has_ends || axis.values.size() == 1 || same_bits(axis.values.back(), b),
            "an axis that doesn't end with b");
  }
}

void check_axis(std::string_view text, Quantity quantity) {
  const config::AxisValues axis = parse_axis(source(text, quantity));
  require(!axis.values.empty(), "an axis without values");
  const bool is_function = axis.text.starts_with('"');
  if (is_function) {
    require(static_cast<double>(axis.values.size()) <= config::max_axis_values, "more values than permitted");
    check_function(axis);
  } else {
    require(axis.locations.size() == axis.values.size(), "values of a list without positions");
  }
  std::string_view again = axis.text;
  if (is_function) again = again.substr(1, again.size() - 2);
  const config::AxisValues second = parse_axis(source(again));
  require(std::ranges::equal(axis.values, second.values, same_bits), "other values from the text: " + axis.text);
  require(axis.text == second.text, axis.text + " gives " + second.text);
}

}  // namespace
}  // namespace clatter::fuzz

/// The first byte chooses how the rest is read: as a number or an axis, without units or as lengths.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) try {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  const auto quantity = (data[0] & 2U) == 0 ? clatter::Quantity::number : clatter::Quantity::length;
  (data[0] & 1U) == 0 ? clatter::fuzz::check_number(text, quantity) : clatter::fuzz::check_axis(text, quantity);
  return 0;
} catch (const clatter::config::ConfigError&) {
  return 0;
}
