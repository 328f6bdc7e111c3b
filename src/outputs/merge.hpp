#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "config/config.hpp"
#include "results/dataset.hpp"
#include "results/shard_file.hpp"

namespace clatter::outputs {

/// Shards that make a whole sweep.
struct ShardSet {
  std::vector<results::ShardHeader> headers;
  config::Config config;
  double bytes = 0.0;  ///< memory that merging takes
};

/// Reads the headers of shards. Throws IoError unless they were computed from one configuration by this very program
/// with one rounding, and have each point of the sweep exactly once.
[[nodiscard]] ShardSet shard_set(const std::vector<std::string>& paths);

/// The results of a whole sweep.
struct Merged {
  results::Dataset dataset;
  std::size_t failed_points = 0;
};

/// Reads all results: the dataset of a single run, bit for bit. Throws IoError, std::bad_alloc.
[[nodiscard]] Merged merge(const ShardSet& shards);

}  // namespace clatter::outputs
