#pragma once

#include <optional>
#include <string>

#include "sweep/run.hpp"
#include "sweep/share.hpp"
#include "sweep/status_tally.hpp"

namespace clatter::app {

/// "501 points, 0 failed"
[[nodiscard]] std::string summary_of_points(const sweep::RunResult& result, const sweep::Sweep& sweep,
                                            const std::optional<results::Shard>& shard);

/// The lines that -v adds: work, threads, host, command line and times; none of them goes into the file.
[[nodiscard]] std::string details(const sweep::RunResult& result, const std::string& command_line,
                                  const std::string& began);

/// The current time in UTC, as ISO 8601.
[[nodiscard]] std::string now();

/// The words that started this process.
[[nodiscard]] std::string command_line();

/// "2 failed (event_budget: 2, e.g. point 0 at nu = 0.5)": how many points of a run failed, how many by each status,
/// and the first of each by its index in the sweep, from 0.
[[nodiscard]] std::string failures_text(const sweep::StatusTally& statuses, const sweep::Sweep& sweep,
                                        const std::optional<results::Shard>& shard = {});

}  // namespace clatter::app
