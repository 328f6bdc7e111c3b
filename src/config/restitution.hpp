#pragma once

#include <optional>
#include <string_view>

#include "config/consistency.hpp"
#include "scene/given_scene.hpp"

namespace clatter::config {

/// The restitution by speed that a key such as R_of_speed gives, with speeds in the unit of its section. Throws
/// ConfigError if the text is no table, or one by which a faster impact rebounds more slowly, or nothing ever rests.
[[nodiscard]] SpeedTable speed_table(const Setting& given);

/// Gives the stops of a scene, and the walls of its loose mass, the tables that its section has.
void set_speed_tables(const Settings& settings, GivenScene& scene);

/// Whether a table takes the place of a key of restitution, for the stop of the key or for one of both.
[[nodiscard]] bool has_speed_table(const Settings& settings, std::string_view name);

/// Under which condition a key has no effect, and how it would have one.
struct NoEffect {
  std::string_view condition, remedy;
};
/// Why a key of restitution has none; nothing: it has one, or is no such key.
[[nodiscard]] std::optional<NoEffect> restitution_without_effect(const Settings& settings, const Key& key);

/// Lets a table of the command line replace the restitution of the file, and the other way round; of one that stands
/// for both stops the other one's stays.
void let_speed_table_or_restitution_win(Settings& settings);

/// Throws ConfigError if a restitution by speed lacks a key, or is given in two ways; and if at some point of the sweep
/// the power law would let a faster impact rebound more slowly at its reference speed.
void check_restitutions(const Settings& settings, const AxisGroups& groups);

}  // namespace clatter::config
