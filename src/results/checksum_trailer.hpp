#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace clatter::results {

/// Files that have a seal, as errors name them.
inline constexpr const char* shards_of_clatter = "files that `clatter run --shard` has written";

/// The seal of a file's bytes, to be put behind them: a line with their number and CRC-32, so that a copy that went
/// wrong isn't taken for results. HDF5 doesn't look behind the end of its own bytes.
[[nodiscard]] std::string checksum_trailer_of(std::span<const std::byte> bytes);

/// Throws IoError where a file cannot be read, has no seal, or has changed since it was sealed.
void require_checksum(const std::string& path);

}  // namespace clatter::results
