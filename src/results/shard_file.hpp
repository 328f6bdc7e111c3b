#pragma once

#include <cstdint>
#include <string>

#include "sweep/dataset.hpp"
#include "sweep/share.hpp"

namespace clatter::results {

/// The header of a shard's file.
struct ShardHeader {
  std::string path;
  sweep::Shard shard;
  std::string schema, version, git_commit, compiler;
  std::string config, config_sha256;
  std::string rounding;       ///< all that its last bits depend on (`rounding_fingerprint`)
  std::uint64_t impacts = 0;  ///< number in its log
  std::uint64_t values = 0;   ///< number in all variables
};

/// Reads the header of a shard's file, if its checksum is right. Throws IoError.
[[nodiscard]] ShardHeader read_shard_header(const std::string& path);

/// Reads the variables of a shard, names and values alone. Throws IoError.
[[nodiscard]] sweep::Dataset read_shard(const std::string& path);

}  // namespace clatter::results
