#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scene/quantity.hpp"

namespace clatter::config {

/// A unit as it was written, such as "mm" or "N s/m": its powers of length, time, mass and angle, and its size.
struct Unit {
  Exponents exponents{};
  int angle = 0;    ///< power of rad
  int turns = 0;    ///< power of a turn, 2 pi rad, in place of rad
  int degrees = 0;  ///< power of a degree, pi/180 rad, in place of rad
  int minutes = 0;  ///< power of a minute, 60 s, in place of s
  int ten = 0;      ///< power of ten of its size in m, s, kg, rad
};

/// A symbol that units are made of, such as "N", and its own unit.
struct Symbol {
  std::string_view name;
  bool takes_prefix = false;
  Unit unit;
};
[[nodiscard]] std::span<const Symbol> unit_symbols();

/// A prefix of the SI, and its power of ten; two are the micro sign and the Greek letter mu, which look the same.
struct Prefix {
  std::string_view name;
  int ten = 0;
};
[[nodiscard]] std::span<const Prefix> unit_prefixes();

/// "m, s, N, ..., %"
[[nodiscard]] std::string unit_names();

/// The unit of one symbol, with a prefix or without: "mm", "rpm".
[[nodiscard]] std::optional<Unit> unit_of_word(std::string_view word);

/// Reads products and quotients of symbols with prefixes of the SI and whole powers: "mm", "N s/m", "rad/s", "m s-1",
/// "kg", "1/min". A factor after '/' divides. Returns nothing if it isn't one.
[[nodiscard]] std::optional<Unit> parse_unit(std::string_view text);

/// Whether a unit is one of that quantity: Hz, rad/s, rpm and 1/min of a frequency, rad and deg of an angle, % of a
/// number.
[[nodiscard]] bool fits(const Unit& unit, Quantity quantity);

/// A value in a unit that fits, in the SI unit of the quantity. A power of ten is one rounding, so 3 mm is 0.003 m.
[[nodiscard]] double in_si(double value, const Unit& unit, Quantity quantity);

/// The unit of a key's numbers that have none, as it is written in values: "N/m"; empty for numbers.
[[nodiscard]] std::string_view unit_of_numbers(Quantity quantity);

/// A key's quantity and its units for messages: "a length in m", "a frequency in Hz, rad/s, rpm or 1/min".
[[nodiscard]] std::string description_of(Quantity quantity);

}  // namespace clatter::config
