#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"

namespace clatter::app {

/// Options of the commands that print a part of an output as text.
inline const Option where_option{"where", 0, "AXIS=VALUE", "points at this value of an axis; repeatable", true};

/// The axes and values of all --where. Throws UsageError.
[[nodiscard]] std::vector<std::pair<std::string, double>> places_of(const Arguments& arguments);

/// The file that -o names; nothing: standard output. Throws UsageError if it is the input, and IoError if it exists,
/// but for --force, or cannot be written.
[[nodiscard]] std::optional<std::string> text_output_of(const Arguments& arguments);

}  // namespace clatter::app
