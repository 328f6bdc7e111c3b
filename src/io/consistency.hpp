#pragma once

#include <cstddef>
#include <vector>

#include "io/settings.hpp"

namespace clatter {

/// The axes of each dimension of a sweep, by their index; linked ones together, the one that names the dimension first.
using AxisGroups = std::vector<std::vector<std::size_t>>;

/// Groups the axes by `linked`. Throws ConfigError where they cannot run together.
[[nodiscard]] AxisGroups group_axes(const Settings& settings);

/// The dimension that `follow` names, or nothing. Throws ConfigError where it names no axis, axes of different
/// dimensions, or a start, which only the first point has.
[[nodiscard]] std::optional<std::size_t> followed_dimension(const Settings& settings, const AxisGroups& groups);

/// Throws ConfigError where two ways of saying the same are mixed, or a key is missing that the others need.
void check_alternatives(const Settings& settings);

/// Throws ConfigError where at some point of the sweep the stops are in the wrong order, or the start is not between
/// them.
void check_stops_and_start(const Settings& settings, const AxisGroups& groups);

}  // namespace clatter
