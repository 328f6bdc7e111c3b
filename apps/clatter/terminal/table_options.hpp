#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tables/point_filter.hpp"
#include "terminal/command_line.hpp"
#include "terminal/common_options.hpp"

namespace clatter::app {

/// Options of the commands that print a part of an output as text.
inline const Option where_option{
    "where", 0, "CONDITION",
    "points that meet this, e.g. nu=1.0, 'gap < 1.5 mm', 'impact_speed < 0.4 m/s' or word=LU; repeatable", true};

/// The conditions of all --where. Throws UsageError.
[[nodiscard]] std::vector<Condition> conditions_of(const Arguments& arguments);

/// The file that -o names; nothing: standard output. Throws UsageError if it is the input, or named as another kind,
/// and IoError if it exists, but for --force, or cannot be written.
[[nodiscard]] std::optional<std::string> text_output_of(const Arguments& arguments, FileKind kind);

}  // namespace clatter::app
