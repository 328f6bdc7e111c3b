#pragma once

#include <cstddef>

#include "lanes/instruction_set.hpp"

namespace clatter::bench {

/// Angles, their sines and cosines: as many as fit into the first-level cache, in whole cache lines.
struct alignas(64) Sines {
  static constexpr std::size_t count = 1024;
  double angles[count], sines[count], cosines[count];
};

/// Batched xsimd sincos of one instruction set, which the machine must have.
template <lanes::InstructionSet arch>
void sincos(Sines& of);

extern template void sincos<lanes::InstructionSet::sse2>(Sines&);
extern template void sincos<lanes::InstructionSet::avx2>(Sines&);
extern template void sincos<lanes::InstructionSet::avx512>(Sines&);

}  // namespace clatter::bench
