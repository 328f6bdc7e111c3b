#include "hdf5_damage.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <random>
#include <set>
#include <string_view>
#include <vector>

#include "support/lookup3.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace clatter::fuzz {
namespace {

/// The positions of a block of metadata, and of the checksum at its end.
struct Summed {
  std::size_t begin, end;
};

/// The position of the checksum of the block that begins here; nothing if no checksum is right. Every length is tried,
/// so that no layout has to be known, but only once for each position; later only lengths that were right somewhere.
std::optional<std::size_t> end_of_block(std::span<const std::uint8_t> file, std::size_t begin) {
  static std::set<std::size_t> lengths, tried;
  const auto is_right = [&](std::size_t length) {
    std::uint32_t stored = 0;
    if (begin + length + sizeof stored > file.size()) return false;
    std::memcpy(&stored, &file[begin + length], sizeof stored);
    return support::lookup3(file.subspan(begin, length)) == stored;
  };
  const auto known = std::ranges::find_if(lengths, is_right);
  if (known != lengths.end()) return begin + *known;
  constexpr std::size_t longest = 1024;
  for (std::size_t length = tried.insert(begin).second ? 8 : longest; length < longest; ++length)
    if (is_right(length)) return begin + *lengths.insert(length).first;
  return std::nullopt;
}

std::vector<Summed> summed_blocks(std::span<const std::uint8_t> file) {
  constexpr std::array<std::string_view, 11> signatures{"OHDR", "OCHK", "FRHP", "FHDB", "FHIB", "BTHD",
                                                        "BTIN", "BTLF", "FSHD", "FSSE", "SMTB"};
  std::vector<Summed> blocks;
  for (std::size_t begin = 0; begin + 4 < file.size(); ++begin) {
    const std::string_view here(reinterpret_cast<const char*>(&file[begin]), 4);
    if (std::ranges::find(signatures, here) == signatures.end()) continue;
    if (const auto end = end_of_block(file, begin)) blocks.push_back({begin, *end});
  }
  return blocks;
}

}  // namespace

std::size_t damage(std::span<std::uint8_t> room, std::size_t size, unsigned seed) {
  std::minstd_rand random(seed);
  const auto below = [&](std::size_t bound) { return bound == 0 ? 0 : static_cast<std::size_t>(random()) % bound; };
  if (size < 64 || below(20) == 0) return LLVMFuzzerMutate(room.data(), size, room.size());
  const std::vector<Summed> blocks = summed_blocks(room.first(size));
  // anywhere, or within a block of metadata
  const auto place = [&](std::size_t length) {
    if (blocks.empty() || below(3) == 0) return below(size - length);
    const Summed& block = blocks[below(blocks.size())];
    return std::min(block.begin + 4 + below(block.end - block.begin), size - length);
  };
  for (std::size_t changes = 1 + below(3); changes-- > 0;) {
    switch (below(8)) {
      case 0:
      case 1:
        room[place(1)] ^= static_cast<std::uint8_t>(1U << below(8));
        break;
      case 2:
        room[place(1)] = static_cast<std::uint8_t>(random());
        break;
      case 3:
      case 4: {
        constexpr std::array<std::uint64_t, 9> limits{0,        1,          0xFF,       0xFFFF, 0xFFFF'FFFF,
                                                      1U << 31, 1ULL << 40, 1ULL << 63, ~0ULL};
        const std::uint64_t number = below(3) == 0 ? size - below(64) : limits[below(limits.size())];
        const std::size_t width = std::size_t{1} << below(4);
        std::memcpy(&room[place(width)], &number, width);
        break;
      }
      case 5: {
        const std::size_t length = std::size_t{1} << below(6);
        std::memset(&room[place(length)], below(4) == 0 ? 0xFF : 0, length);
        break;
      }
      case 6: {
        const std::size_t length = std::size_t{1} << below(6);
        std::memmove(&room[place(length)], &room[place(length)], length);
        break;
      }
      default:
        if (below(4) == 0) size = 64 + below(size - 64);
        break;
    }
    if (size < 128) return size;
  }
  if (below(5) == 0) return size;
  for (const auto& [begin, end] : blocks) {
    if (end + 4 > size) continue;
    const std::uint32_t sum = support::lookup3(room.subspan(begin, end - begin));
    std::memcpy(&room[end], &sum, sizeof sum);
  }
  return size;
}

}  // namespace clatter::fuzz
