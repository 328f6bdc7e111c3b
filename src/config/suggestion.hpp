#pragma once

#include <span>
#include <string>
#include <string_view>

#include "config/keys.hpp"

namespace clatter::config {

/// Quotes a text for a one-line message: in single quotes, made printable, cut after 60 bytes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A text with its ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// The name that the written word abbreviates, else the nearest one by edit distance; empty if none is near.
[[nodiscard]] std::string_view nearest(std::string_view written, std::span<const std::string_view> names);

/// "; did you mean 'nu'?" if a name is near, else all names after `otherwise`, e.g. "; expected one of h, f, nu".
[[nodiscard]] std::string suggestion(std::string_view written, std::span<const std::string_view> names,
                                     std::string_view otherwise);

/// "h, f, nu"
[[nodiscard]] std::string joined(std::span<const std::string_view> names);

/// "; a decimal comma? write 0.1" if a text would be a number without its comma, such as 0,1; of 2,000 also ";
/// thousands? write 2000"; for whole numbers "; write it without commas: 10000"; else nothing.
[[nodiscard]] std::string comma_hint(std::string_view text, Kind kind = Kind::number);

/// The hint for the first number with a decimal comma in a text, as in linspace(0,5, 1,5, 501).
[[nodiscard]] std::string comma_hint_within(std::string_view text);

}  // namespace clatter::config
