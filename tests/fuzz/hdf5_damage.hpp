#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace clatter::fuzz {

/// Changes a file as disks, copies and attackers do: bits, blocks of zeros, copied blocks, numbers at their limits,
/// cuts. Mostly the checksums are corrected afterwards, since HDF5 reads on only if they are right. Returns the new
/// size.
[[nodiscard]] std::size_t damage(std::span<std::uint8_t> room, std::size_t size, unsigned seed);

}  // namespace clatter::fuzz
