#pragma once

#include <optional>

#include "config/config.hpp"
#include "plan/memory_need.hpp"

namespace clatter::app {

/// The need of a run with what its configuration takes besides the sweep: as a text; if reading it has taken more than
/// all the rest, that.
[[nodiscard]] plan::MemoryNeed with_configuration(plan::MemoryNeed need, const config::Config& config);

/// Throws IoError where a run would not fit into memory: too late to find out at its end.
void check_memory(const config::Config& config, const std::optional<sweep::Shard>& shard, int threads);

/// Throws IoError where merging, which takes so many bytes, would not fit.
void check_merge_memory(double bytes);

}  // namespace clatter::app
