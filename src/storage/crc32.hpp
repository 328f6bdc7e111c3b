#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace clatter::storage {

/// CRC-32, as zlib computes it, of bytes that follow those with the CRC-32 `before`.
[[nodiscard]] std::uint32_t crc32_of(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace clatter::storage
