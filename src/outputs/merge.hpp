#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "config/config.hpp"
#include "results/output_place.hpp"
#include "results/shard_file.hpp"
#include "sweep/joined.hpp"
#include "sweep/status_tally.hpp"

namespace clatter::outputs {

/// Shards that make a whole sweep.
struct ShardSet {
  std::vector<results::ShardHeader> headers;
  config::Config config;
  double bytes = 0.0;         ///< memory that merging takes
  double output_bytes = 0.0;  ///< the merged file before compression
};

/// Reads the headers of shards. Throws IoError unless they were computed from one configuration by this very program
/// with one rounding, and have each point of the sweep exactly once.
[[nodiscard]] ShardSet shard_set(const std::vector<std::string>& paths);

/// The merge of shards into one file.
class Merge {
 public:
  /// `shards` has to be there as long.
  explicit Merge(const ShardSet& shards);
  Merge(const Merge&) = delete;
  Merge& operator=(const Merge&) = delete;

  /// Writes the file of a single run, byte for byte; the shards are read part by part meanwhile. Throws IoError,
  /// std::bad_alloc.
  sweep::StatusTally write(const results::OutputPlace& place);

 private:
  [[nodiscard]] results::ShardReader& reader(std::size_t shard);

  const ShardSet& shards_;
  std::vector<results::ShardReader> readers_;  ///< [shard]
  std::deque<std::size_t> open_;               ///< shards whose files may be open, the one opened first in front
  std::vector<sweep::Part> parts_;             ///< [shard]
};

}  // namespace clatter::outputs
