#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.hpp"

namespace clatter::config {

/// The names between the commas of `linked` or `follow`.
[[nodiscard]] std::vector<std::string> split_names(std::string_view text);

/// The axes of each dimension of a sweep, by their index; linked ones together, the one that names the dimension first.
using AxisGroups = std::vector<std::vector<std::size_t>>;

/// Groups the axes by `linked`. Throws ConfigError where they cannot run together.
[[nodiscard]] AxisGroups group_axes(const Settings& settings);

/// The dimension that `follow` names, or nothing. Throws ConfigError where it names no axis, axes of different
/// dimensions, or a start, which only the first point has.
[[nodiscard]] std::optional<std::size_t> followed_dimension(const Settings& settings, const AxisGroups& groups);

/// Takes away what the file says in another way than the command line, be it of [scene] or of [sweep], xs or
/// stop_lower, and notes it in `displaced`. Of a pair, as xs is of stops, what isn't said anew stays. Throws
/// ConfigError where the file, or the command line, says the same in two ways.
void let_command_line_win(Settings& settings);

/// Throws ConfigError where a key is missing that the others need, or does not go with them.
void check_alternatives(const Settings& settings);

/// Throws ConfigError where at some point of the sweep the stops are in the wrong order, or the start is not between
/// them.
void check_stops_and_start(const Settings& settings, const AxisGroups& groups);

/// What looks unintended: keys without effect, values twice on an axis, a run that observes nothing.
[[nodiscard]] std::vector<Warning> warnings_of(const Settings& settings, const AxisGroups& groups);

}  // namespace clatter::config
