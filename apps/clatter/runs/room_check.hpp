#pragma once

#include <optional>
#include <string>

#include "config/config.hpp"
#include "outputs/merge.hpp"
#include "plan/memory_need.hpp"

namespace clatter::app {

/// The need of a run, with the copies of its configuration's text. Throws IoError if the run would not fit into memory,
/// before it begins rather than at its end.
[[nodiscard]] plan::MemoryNeed check_memory(const config::Config& config, const std::optional<results::Shard>& shard,
                                            int threads);

/// Throws IoError if the disk of an output can't hold it, and what else a run of this need keeps beside it; its journal
/// gives way. The length of an impact log, and of what is deflated, isn't known before.
void check_disk(const config::Config& config, const plan::MemoryNeed& need, const std::string& output);

/// Throws IoError if merging would not fit into memory, or its output not onto the disk.
void check_merge(const outputs::ShardSet& shards, const std::string& output);

}  // namespace clatter::app
