#pragma once

#include <optional>
#include <string>

#include "config/settings.hpp"
#include "scene/force_table.hpp"

namespace clatter::config {

inline constexpr std::size_t max_force_rows = 100'000;

/// A force as it was measured: the rows of `force_table`.
struct MeasuredForce {
  ForceTable table;
  double period = 0.0;  ///< from the first row to the last, in tau or s; 0 if the rows give phases
};

/// Replaces the name of a file that `force_table` gives by the rows that it holds, so that a configuration is complete
/// without the file. A name counts from the configuration, on the command line from the working directory. Throws
/// ConfigError if the file can't be read or holds no table.
void read_force_table(Settings& settings);

/// The table that the settings give, if there is one, with forces as written, in N in [machine].
[[nodiscard]] std::optional<MeasuredForce> measured_force(const Settings& settings);

/// The length of its text; 0: there is none.
[[nodiscard]] std::size_t bytes_of_force_table(const Settings& settings);

/// Whether the settings give a table in place of f or force.
[[nodiscard]] bool has_force_table(const Settings& settings);

/// Lets a table on the command line replace the force of the file, and the other way round.
void let_force_table_or_force_win(Settings& settings);

/// Throws ConfigError if a table stands beside another force.
void check_force_table(const Settings& settings);

/// By how much the measured period is stretched to that of the force: "... stretched by 1.25 to that of nu"; empty if
/// it isn't, or the table gives phases.
[[nodiscard]] std::string stretch_of_force(const Settings& settings);

}  // namespace clatter::config
