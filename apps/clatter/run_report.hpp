#pragma once

#include <optional>
#include <string>

#include "sweep/run.hpp"

namespace clatter::app {

/// "501 points, 0 failed"
[[nodiscard]] std::string summary_of_points(const sweep::RunResult& result, const sweep::Sweep& sweep,
                                            const std::optional<sweep::Shard>& shard);

/// The lines that -v adds: work, threads, host, command line and times; none of them goes into the file.
[[nodiscard]] std::string details(const sweep::RunResult& result, const std::string& command_line,
                                  const std::string& began);

/// The current time in UTC, as ISO 8601.
[[nodiscard]] std::string now();

/// The words that started this process.
[[nodiscard]] std::string command_line();

}  // namespace clatter::app
