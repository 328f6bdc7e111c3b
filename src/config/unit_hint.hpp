#pragma once

#include <string>
#include <string_view>

#include "scene/quantity.hpp"

namespace clatter::config {

/// What to write in place of an unknown unit: "; did you mean 'N s/m'?" for "Ns/m", "; 1 inch is 25.4 mm"; empty if
/// nothing that fits the quantity is known.
[[nodiscard]] std::string unit_hint(std::string_view text, Quantity quantity);

}  // namespace clatter::config
