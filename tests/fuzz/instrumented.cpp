// Compiled without instrumentation, which has names of its own for the table below.
#include "instrumented.hpp"

#include <algorithm>
#include <span>

/// The table of instrumented code: a block of it each.
struct Block {
  std::uintptr_t address, flags;
};

extern "C" const Block first_block asm("__start___sancov_pcs");
extern "C" const Block end_of_blocks asm("__stop___sancov_pcs");

namespace clatter::fuzz {

bool is_instrumented(std::uintptr_t address) {
  static const auto ends = std::ranges::minmax(std::span(&first_block, &end_of_blocks), {}, &Block::address);
  return address >= ends.min.address && address <= ends.max.address;
}

}  // namespace clatter::fuzz
