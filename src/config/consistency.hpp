#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.hpp"
#include "scene/stops.hpp"

namespace clatter::config {

struct Warning;

/// The names between the commas of `linked` or `follow`.
[[nodiscard]] std::vector<std::string> split_names(std::string_view text);

/// Gives each axis of sobol(a, b, n) a dimension of the sequence, in the order of the axes. Throws ConfigError if
/// several are not linked, or if an end isn't permitted for the key.
void spread_sobol(Settings& settings);

/// The axes of each dimension of a sweep by index: linked ones together, beginning with the one that names the
/// dimension.
using AxisGroups = std::vector<std::vector<std::size_t>>;

/// Groups the axes by `linked`. Throws ConfigError if they cannot run together.
[[nodiscard]] AxisGroups group_axes(const Settings& settings);

/// The message that a setting names something: "sensitivity names 'R'".
[[nodiscard]] std::string names_key(const Setting& setting, std::string_view name);

/// The quantity in which the scene gives a key, or one that stands for it; nothing if none is given.
[[nodiscard]] std::optional<Quantity> quantity_given(const Settings& settings, Parameter key);

/// The parameters of the scene that a key names, as they are given. Throws ConfigError at a name that is none, or by
/// which steady motion has no derivative.
[[nodiscard]] ParameterSet named_parameters(const Settings& settings, std::string_view section, std::string_view name);

/// Throws ConfigError if derivatives are asked for that the motion, or the method, doesn't have.
void check_sensitivity(const Settings& settings);

/// The dimension that `follow` names, or nothing. Throws ConfigError if it names no axis, axes of different dimensions,
/// or a start, which only the first point has.
[[nodiscard]] std::optional<std::size_t> followed_dimension(const Settings& settings, const AxisGroups& groups);

/// Removes settings of the file that the command line replaces by another key or section, such as xs by stop_lower, and
/// notes them in `replaced`; likewise a value beside an axis of its key. If only one half of a pair is replaced, such
/// as one stop of xs, the other stays. Throws ConfigError if the file alone, or the command line alone, says the same
/// in two ways.
void let_command_line_win(Settings& settings);

/// Throws ConfigError if a key is missing that others need, or if keys conflict.
void check_alternatives(const Settings& settings);

/// Throws ConfigError if at some point of the sweep the stops are in the wrong order, the start is not between them, or
/// stops and start are none that shaking or friction go with.
void check_stops_and_start(const Settings& settings, const AxisGroups& groups);

/// Throws ConfigError if something is asked for that isn't known of stops that move by themselves, if one of these
/// isn't there, if the stops come together at some point of the sweep, or the start is not between them.
void check_stop_motion(const Settings& settings, const AxisGroups& groups);
/// Whether a stop moves by itself at some point of the sweep.
[[nodiscard]] bool stops_move_by_themselves(const Settings& settings);

/// Throws ConfigError if a loose mass lacks a key that it needs, or something is asked for that it doesn't have; and if
/// at some point of the sweep it has no wall or no force that it needs, its walls are in the wrong order, or it doesn't
/// start between them.
void check_loose_mass(const Settings& settings);
void check_housing(const Settings& settings, const AxisGroups& groups);

/// Throws ConfigError if the restitution of a soft wall is given for one that is rigid at some point, or something is
/// asked for that isn't known of soft walls.
void check_soft_walls(const Settings& settings, const AxisGroups& groups);
/// Whether a wall of a loose mass is soft at some point of the sweep, or at every one.
[[nodiscard]] bool is_soft_wall_somewhere(const Settings& settings, Side side);
[[nodiscard]] bool is_soft_wall_everywhere(const Settings& settings, Side side);

/// Whether there is a loose mass.
[[nodiscard]] bool has_loose_mass(const Settings& settings);
/// Whether it rubs on its housing at some point of the sweep.
[[nodiscard]] bool has_loose_friction(const Settings& settings);
/// Whether the main mass that carries it has stops or friction at some point of the sweep.
[[nodiscard]] bool has_main_events(const Settings& settings);
/// Whether a parameter is of what a main mass that carries a loose one lacks: stops of its own, and friction.
[[nodiscard]] bool conflicts_with_loose_mass(Parameter parameter);

/// Whether there is dry friction at some point of the sweep.
[[nodiscard]] bool has_friction_somewhere(const Settings& settings);

/// Whether a stop is soft at some point of the sweep, or at every one.
[[nodiscard]] bool is_soft_somewhere(const Settings& settings, Side side);
[[nodiscard]] bool is_soft_everywhere(const Settings& settings, Side side);

/// The dimension of a sweep along which a setting varies; nothing if it has one value.
[[nodiscard]] std::optional<std::size_t> dimension_of(const Settings& settings, const Setting* given,
                                                      const AxisGroups& groups);

/// Throws ConfigError if soft stops can't hold the mass at some point of the sweep.
void check_soft_stops(const Settings& settings, const AxisGroups& groups);

/// Warns of keys without effect, values twice on an axis, and a run that observes nothing.
[[nodiscard]] std::vector<Warning> warnings_of(const Settings& settings, const AxisGroups& groups);

/// Of these, the warnings of keys that change nothing with the others, except those at their default, as in a complete
/// text.
[[nodiscard]] std::vector<Warning> keys_without_effect(const Settings& settings);

}  // namespace clatter::config
