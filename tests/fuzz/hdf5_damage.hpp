#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace clatter::fuzz {

/// Changes a file as disks, copies and attackers do: bits, blocks of zeros, copied blocks, numbers at their limits,
/// cuts. Most times the checksums are set right afterwards, since HDF5 reads on only where they are. Gives the new
/// size.
[[nodiscard]] std::size_t damage(std::span<std::uint8_t> room, std::size_t size, unsigned seed);

}  // namespace clatter::fuzz
