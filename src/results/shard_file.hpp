#pragma once

#include <cstdint>
#include <string>

#include "sweep/figure.hpp"
#include "sweep/share.hpp"

namespace clatter {

/// What a shard's file says of itself.
struct ShardHead {
  std::string path;
  Shard shard;
  std::string schema, version, git_commit, compiler;
  std::string config, config_sha256;
  std::string rounding;       ///< what its last bits depend on
  std::uint64_t impacts = 0;  ///< in its log
  std::uint64_t values = 0;   ///< of all variables
};

/// Reads what a shard's file says of itself, once its seal is found whole. Throws IoError.
[[nodiscard]] ShardHead read_shard_head(const std::string& path);

/// Reads the variables of a shard, names and values alone. Throws IoError.
[[nodiscard]] Figure read_shard(const std::string& path);

}  // namespace clatter
