#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config/value_grammar.hpp"
#include "scene/quantity.hpp"

namespace clatter::config {

/// A number as it was written, of whatever quantity its unit says.
struct Reading {
  double value = 0.0;                    ///< in the SI unit of the quantity
  Quantity quantity = Quantity::number;  ///< number: without unit, too
  std::string unit{};                    ///< as it was written; empty: none
};

/// Reads a number with a unit of any quantity, or with none: 1.5 mm, 2*pi rad/s, 0.5. Throws ConfigError.
[[nodiscard]] Reading parse_reading(const SourceText& source);

/// The quantity that has this SI unit, as files name it: "m s-1"; nothing if none has.
[[nodiscard]] std::optional<Quantity> quantity_in(std::string_view si_unit);

/// A reading in a unit of a file. Throws ConfigError, at the location, if its own unit doesn't fit; `what` is what the
/// file holds in that unit, for the message: "'gap' in 'a.h5'".
[[nodiscard]] double in_unit_of_file(const Reading& reading, std::string_view unit, const SourceLocation& location,
                                     const std::string& what);

}  // namespace clatter::config
