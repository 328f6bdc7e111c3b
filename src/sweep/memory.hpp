#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter {

/// Bytes that the results of a sweep, or of a shard, take; the impact log, whose length nobody knows beforehand, comes
/// on top.
[[nodiscard]] double result_bytes(const Sweep& sweep, const std::optional<Shard>& shard = {});

/// Bytes in memory at the end of a run, so that a sweep that cannot fit is refused before hours of computing: the
/// results, each variable of which leaves once it is in the file's image, and the largest of them in both places.
[[nodiscard]] double run_bytes(const Sweep& sweep, const std::optional<Shard>& shard = {});

/// A shard and the length of its impact log.
struct ShardSize {
  Shard shard;
  std::size_t impacts = 0;
};

/// Bytes that merging shards takes: those of a run, its impact log, and the largest shard beside them; or, when the
/// file is built, the columns of the log and the largest variable once more.
[[nodiscard]] double merge_bytes(const Sweep& sweep, std::span<const ShardSize> shards);

/// Memory in bytes that this process may have: of the machine, of its control group (a job of a batch system, a
/// container), of `ulimit -v`; 0 where it isn't told.
[[nodiscard]] double machine_bytes();

}  // namespace clatter
