#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/config_error.hpp"
#include "scene/quantity.hpp"

namespace clatter::config {

/// A text to be read as a number or an axis, with its location.
struct SourceText {
  std::string_view text;
  SourceLocation location;               ///< of its first character
  bool columns = false;                  ///< the text is on one line there, so a mistake inside has a column of its own
  Quantity quantity = Quantity::number;  ///< that its numbers are; of a number, units are refused
  std::string_view unit{};               ///< that numbers need in the text of an axis to be read as that quantity
  std::string_view way_out{};            ///< of a unit there, besides leaving it out: ", or ..."
};

/// A number in SI, and whether it was written with a unit.
struct Measure {
  double value = 0.0;
  bool has_unit = false;
};

/// Two numbers, the lower first.
using Interval = std::array<double, 2>;

/// The values of an axis, and the text that reads back to them.
struct AxisValues {
  std::vector<double> values;
  std::vector<SourceLocation> locations;  ///< of each element of a list; empty for those of a function
  std::optional<std::array<double, 2>>
      sobol{};  ///< a and b of sobol(a, b, n); the values are those of the first dimension until all axes are known
  std::string text;  ///< TOML: "\"linspace(0.5, 1.5, 501)\"" or "[1.0, 2.0]"

  [[nodiscard]] bool operator==(const AxisValues&) const = default;
};

/// The largest number of values of an axis, and of points of a sweep.
inline constexpr double max_axis_values = 1e7;
inline constexpr double max_points = 1e9;

/// Reads a number, in which `pi` may stand as a number or factor: 0.5, pi, -2*pi/3, inf. Throws ConfigError.
[[nodiscard]] double parse_number(const SourceText& source);

/// Reads a number with its unit, if there is one: 3 mm, 2*pi rad/s. Throws ConfigError.
[[nodiscard]] Measure parse_measure(const SourceText& source);

/// A number that begins a text, and all that follows it, such as a unit.
struct LeadingNumber {
  double value;
  std::string_view rest;
};

/// Throws ConfigError if the text doesn't begin with a number.
[[nodiscard]] LeadingNumber parse_leading_number(const SourceText& source);

/// Reads linspace(a, b, n), logspace(a, b, n), arange(a, b, step), sobol(a, b, n), or numbers between commas in
/// optional brackets; all numbers with units, or none. Throws ConfigError.
[[nodiscard]] AxisValues parse_axis(const SourceText& source);

/// Throws ConfigError if one of several numbers has no unit and others do; 0 and infinity need none.
void check_units(const std::vector<Measure>& measures, const std::vector<SourceLocation>& locations);

/// The shortest text that reads back to the same number.
[[nodiscard]] std::string number_text(double value);

/// That text as a TOML float: 1.0, not 1.
[[nodiscard]] std::string toml_number(double value);
/// A number and its unit as a TOML string, in quotes.
[[nodiscard]] std::string toml_measure(double value, std::string_view unit);

/// TOML text of a list of numbers, each with a unit if there is one.
[[nodiscard]] std::string toml_list(const std::vector<double>& values, std::string_view unit = {});

/// Whether a text has a word that is neither a number, as inf and pi, nor a function: a unit, or a slip.
[[nodiscard]] bool has_unit(std::string_view text);

}  // namespace clatter::config
