#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "storage/file_writer.hpp"

namespace clatter::results {

/// Files that have a checksum trailer, as errors name them.
inline constexpr const char* shards_of_clatter = "files that `clatter run --shard` has written";

/// The checksum trailer that belongs behind so many bytes with this CRC-32: a line with both, so that a faulty copy
/// isn't taken for results. HDF5 ignores bytes behind its own.
[[nodiscard]] std::string checksum_trailer_of(std::uint64_t length, std::uint32_t crc);

/// Puts the checksum trailer behind the `length` bytes of a file. Throws IoError.
void add_checksum(storage::FileWriter& file, std::uint64_t length);

/// Throws IoError if a file cannot be read, has no checksum trailer, or has changed since that was written.
void require_checksum(const std::string& path);

/// The SHA-256 digest of a text in hexadecimal, which shows whether two files come from the same configuration.
[[nodiscard]] std::string sha256(std::string_view text);

}  // namespace clatter::results
