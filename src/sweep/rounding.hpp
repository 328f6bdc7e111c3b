#pragma once

#include <string>

#include "numbers/arch.hpp"
#include "sweep/sweep.hpp"

namespace clatter {

/// What the last bits of a sweep's results depend on beside the program: the instruction set of its lanes, and what the
/// mathematical library and FFTW make of this processor. They choose their instructions by themselves, so their results
/// are asked: "avx2 or avx512, functions 5d2f0c1e". Runs with the same words give the same bits.
[[nodiscard]] std::string rounding_of(const Sweep& sweep, Arch arch);

}  // namespace clatter
