#pragma once

#include <cstddef>
#include <optional>

#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter::plan {

/// Bytes that a run takes, known before it begins.
struct MemoryNeed {
  double output = 0.0;  ///< the file before compression: results and coordinates
  double memory = 0.0;  ///< peak memory, the program included, so that a sweep that can't fit is refused before the run
  double log = 0.0;     ///< the impact log's part of `memory`: an estimate, as its length isn't known before the run
  double in_files = 0.0;  ///< results that don't go into memory: in files beside the output until that is written
  double journal = 0.0;   ///< the journal, if the run isn't over within a second
  double logged = 0.0;    ///< the impact log's part of `output`, an estimate
  double merging = 0.0;   ///< memory in which shards of this size are merged into the whole sweep, at most

  /// The most that a run takes of its disk: its journal and, for a while, its results twice.
  [[nodiscard]] double disk() const { return output + in_files + journal; }
};

/// The need of a sweep, or of a shard.
[[nodiscard]] MemoryNeed memory_need(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard = {},
                                     int threads = 1);

/// The need of a sweep, or of a shard, with so many impacts in its log.
[[nodiscard]] MemoryNeed memory_need(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard, int threads,
                                     double impacts);

/// Bytes of memory that merging so many shards of a sweep takes, with so many impacts in all logs, and deflated at this
/// level.
[[nodiscard]] double merge_bytes(const sweep::Sweep& sweep, std::size_t shards, double impacts, int level = 1);

/// An estimate of the impacts in the log of a sweep or a shard, from short runs of a few of its points.
[[nodiscard]] double expected_impacts(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard);

}  // namespace clatter::plan
