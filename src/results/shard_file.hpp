#pragma once

#include <cstdint>
#include <string>

#include "sweep/dataset.hpp"
#include "sweep/share.hpp"

namespace clatter::results {

/// What a shard's file says of itself.
struct ShardHeader {
  std::string path;
  sweep::Shard shard;
  std::string schema, version, git_commit, compiler;
  std::string config, config_sha256;
  std::string rounding;       ///< what its last bits depend on
  std::uint64_t impacts = 0;  ///< in its log
  std::uint64_t values = 0;   ///< of all variables
};

/// Reads what a shard's file says of itself, once its seal is found whole. Throws IoError.
[[nodiscard]] ShardHeader read_shard_header(const std::string& path);

/// Reads the variables of a shard, names and values alone. Throws IoError.
[[nodiscard]] sweep::Dataset read_shard(const std::string& path);

}  // namespace clatter::results
