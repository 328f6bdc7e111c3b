#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "file_points.hpp"

namespace clatter::app {

/// Options of the commands that print a part of an output as text.
inline const Option where_option{"where", 0, "AXIS=VALUE",
                                 "points at this value of an axis, e.g. nu=1.0 or gap='1.5 mm'; repeatable", true};

/// The axes and values of all --where, as they were written. Throws UsageError.
[[nodiscard]] std::vector<Place> places_of(const Arguments& arguments);

/// The file that -o names; nothing: standard output. Throws UsageError if it is the input, and IoError if it exists,
/// but for --force, or cannot be written.
[[nodiscard]] std::optional<std::string> text_output_of(const Arguments& arguments);

}  // namespace clatter::app
