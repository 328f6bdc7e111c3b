#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace clatter::results {

/// Files that have a checksum trailer, as errors name them.
inline constexpr const char* shards_of_clatter = "files that `clatter run --shard` has written";

/// The checksum trailer to put behind a file's bytes: a line with their number and CRC-32, so that a faulty copy isn't
/// taken for results. HDF5 ignores bytes behind its own.
[[nodiscard]] std::string checksum_trailer_of(std::span<const std::byte> bytes);

/// Throws IoError if a file cannot be read, has no checksum trailer, or has changed since that was written.
void require_checksum(const std::string& path);

/// The SHA-256 digest of a text in hexadecimal, which shows whether two files come from the same configuration.
[[nodiscard]] std::string sha256(std::string_view text);

}  // namespace clatter::results
