#pragma once

#include <optional>

#include "config/config.hpp"
#include "plan/memory_need.hpp"

namespace clatter::app {

/// Adds the copies of the configuration's text to a run's need; if reading the configuration took more than all that,
/// the need is that peak.
[[nodiscard]] plan::MemoryNeed with_configuration(plan::MemoryNeed need, const config::Config& config);

/// Throws IoError if a run would not fit into memory, before it begins rather than at its end.
void check_memory(const config::Config& config, const std::optional<sweep::Shard>& shard, int threads);

/// Throws IoError if merging, which takes so many bytes, would not fit.
void check_merge_memory(double bytes);

}  // namespace clatter::app
