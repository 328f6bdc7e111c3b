#pragma once

#include <optional>

#include "config/config.hpp"
#include "plan/memory_need.hpp"

namespace clatter::app {

/// The need of a run, with the copies of its configuration's text. Throws IoError if the run would not fit into memory,
/// before it begins rather than at its end.
[[nodiscard]] plan::MemoryNeed check_memory(const config::Config& config, const std::optional<results::Shard>& shard,
                                            int threads);

/// Throws IoError if merging, which takes so many bytes, would not fit.
void check_merge_memory(double bytes);

}  // namespace clatter::app
