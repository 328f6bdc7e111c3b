#pragma once

#include <cstddef>
#include <string>

#include "config/settings.hpp"

namespace clatter::config {

inline constexpr std::size_t max_force_rows = 100'000;

/// Reads the rows of `force_table` into `measured_force`, and replaces the name of a file that `force_table` gives by
/// the rows that it holds, so that a configuration is complete without the file. A name counts from the configuration,
/// on the command line from the working directory. Throws ConfigError if the file can't be read or holds no table.
void read_force_table(Settings& settings);

/// The length of its text; 0: there is none.
[[nodiscard]] std::size_t bytes_of_force_table(const Settings& settings);

/// Whether the settings give a table in place of f or force.
[[nodiscard]] bool has_force_table(const Settings& settings);

/// Lets a table on the command line replace the force of the file, and the other way round.
void let_force_table_or_force_win(Settings& settings);

/// The number of its orders that are taken in place of its lines; 0: the lines are.
[[nodiscard]] std::size_t harmonics_of_table(const Settings& settings);

/// Throws ConfigError if a table stands beside another force.
void check_force_table(const Settings& settings);

/// By how much the measured period is stretched to that of the force, and what orders of it leave out; empty if it
/// isn't stretched, or the table gives phases, and its lines are taken.
[[nodiscard]] std::string told_of_force_table(const Settings& settings);

}  // namespace clatter::config
