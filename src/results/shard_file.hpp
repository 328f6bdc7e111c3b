#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "results/dataset.hpp"
#include "results/shard.hpp"

namespace clatter::results {

/// The header of a shard's file.
struct ShardHeader {
  std::string path;
  Shard shard;
  std::string schema, version, git_commit, compiler;
  std::string config, config_sha256;
  std::string rounding;       ///< all that its last bits depend on (`rounding_fingerprint`)
  std::uint64_t impacts = 0;  ///< number in its log
  std::uint64_t values = 0;   ///< number in all variables
};

/// The most values that a run writes by a shard's configuration; nothing if that can't be read.
using MostValues = std::function<std::optional<double>(const ShardHeader&)>;

/// Reads the header of a shard's file, if its checksum is right and it holds no more values than it can have. Throws
/// IoError.
[[nodiscard]] ShardHeader read_shard_header(const std::string& path, const MostValues& most_values);

/// Reads the variables of a shard, names and values alone. Throws IoError.
[[nodiscard]] Dataset read_shard(const std::string& path);

}  // namespace clatter::results
