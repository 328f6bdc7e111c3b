// Compiled without instrumentation, since that reserves the names of the table below.
#include "instrumented.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

/// The table of instrumented code, with an entry for each block.
struct Block {
  std::uintptr_t address, flags;
};

extern "C" const Block first_block asm("__start___sancov_pcs");
extern "C" const Block end_of_blocks asm("__stop___sancov_pcs");

namespace clatter::fuzz {

/// Instrumented code isn't contiguous: functions that run before main come first.
bool is_instrumented(std::uintptr_t address) {
  constexpr std::uintptr_t longest = 4096;  // bytes of a block
  static const std::vector<std::uintptr_t> blocks = [] {
    std::vector<std::uintptr_t> all;
    for (const Block& block : std::span(&first_block, &end_of_blocks)) all.push_back(block.address);
    std::ranges::sort(all);
    return all;
  }();
  const auto after = std::ranges::upper_bound(blocks, address);
  return after != blocks.begin() && address - *std::prev(after) < longest;
}

}  // namespace clatter::fuzz
