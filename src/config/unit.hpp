#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/quantity.hpp"

namespace clatter::config {

/// A unit as it was written, such as "mm" or "N s/m": its powers of length, time, mass and angle, and its size.
struct Unit {
  Exponents exponents{};
  int angle = 0;  ///< power of rad
  int turns = 0;  ///< power of a turn, 2 pi rad, in place of rad
  int ten = 0;    ///< power of ten of its size in m, s, kg, rad
};

/// Reads products and quotients of m, s, N, g, Hz and rad with prefixes of the SI and whole powers: "mm", "N s/m",
/// "rad/s", "m s-1", "kg". Each factor after '/' divides. Returns nothing if it isn't one.
[[nodiscard]] std::optional<Unit> parse_unit(std::string_view text);

/// Whether a unit is one of that quantity: Hz and rad/s of a frequency, rad of an angle.
[[nodiscard]] bool fits(const Unit& unit, Quantity quantity);

/// A value in a unit that fits, in the SI unit of the quantity. A power of ten is one rounding, so 3 mm is 0.003 m.
[[nodiscard]] double in_si(double value, const Unit& unit, Quantity quantity);

/// The unit of a key's numbers that have none, as it is written in values: "N/m"; empty for numbers.
[[nodiscard]] std::string_view unit_of_numbers(Quantity quantity);

/// A key's quantity and its unit for messages: "a length in m", "a frequency in Hz or rad/s".
[[nodiscard]] std::string description_of(Quantity quantity);

}  // namespace clatter::config
