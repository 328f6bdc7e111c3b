#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter::plan {

/// Bytes that a run takes, known before it begins.
struct MemoryNeed {
  double output = 0.0;  ///< the file before compression: results and coordinates
  double memory = 0.0;  ///< peak memory, the program included, so that a sweep that can't fit is refused before the run
  double log = 0.0;     ///< the impact log's part of `memory`: an estimate, as its length isn't known before the run
};

/// The need of a sweep, or of a shard.
[[nodiscard]] MemoryNeed memory_need(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard = {},
                                     int threads = 1);

/// The need of a sweep, or of a shard, with so many impacts in its log.
[[nodiscard]] MemoryNeed memory_need(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard, int threads,
                                     double impacts);

/// A shard and the length of its impact log.
struct ShardSize {
  results::Shard shard;
  std::size_t impacts = 0;
};

/// Bytes that merging shards takes: those of a run that has all results already, and those of the largest shard.
[[nodiscard]] double merge_bytes(const sweep::Sweep& sweep, std::span<const ShardSize> shards);

/// An estimate of the impacts in the log of a sweep or a shard, from short runs of a few of its points.
[[nodiscard]] double expected_impacts(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard);

}  // namespace clatter::plan
