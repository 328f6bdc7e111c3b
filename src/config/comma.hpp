#pragma once

#include <string>
#include <string_view>

#include "config/keys.hpp"

namespace clatter::config {

/// "; a decimal comma? write 0.1" if a text would be a number without its comma, such as 0,1; for whole numbers ";
/// write it without commas: 10000"; else nothing.
[[nodiscard]] std::string comma_hint(std::string_view text, Kind kind = Kind::number);

/// The same for the first such number in a text, as in linspace(0,5, 1,5, 501).
[[nodiscard]] std::string comma_hint_within(std::string_view text);

}  // namespace clatter::config
