#pragma once

#include <optional>

#include "config/config.hpp"
#include "plan/memory_need.hpp"
#include "sweep/run.hpp"

namespace clatter::app {

/// The wall time of a run in seconds, observables and writing included, from running evenly spaced points of its sweep:
/// more and more of them, until some tenths of a second are spent, or all of them. Nothing if not even part of a point
/// can be run in that time, or a single one may take long. The trial takes little memory beside the run.
[[nodiscard]] std::optional<double> foretold_seconds(const config::Config& config, const sweep::RunOptions& options,
                                                     const std::optional<results::Shard>& shard,
                                                     const plan::MemoryNeed& need);

}  // namespace clatter::app
