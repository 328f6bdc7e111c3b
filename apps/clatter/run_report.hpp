#pragma once

#include <optional>
#include <string>

#include "sweep/run.hpp"

namespace clatter::app {

/// The line that ends a run: points, failures, seconds, file.
[[nodiscard]] std::string summary_line(const sweep::RunResult& result, const sweep::Sweep& sweep,
                                       const std::optional<sweep::Shard>& shard, const std::string& output);

/// What -v adds: what it took, where and when; none of it goes into the file.
[[nodiscard]] std::string details(const sweep::RunResult& result, const std::string& command_line,
                                  const std::string& began);

/// The time of day in UTC, ISO 8601.
[[nodiscard]] std::string now();

/// The words that started this process.
[[nodiscard]] std::string command_line();

}  // namespace clatter::app
