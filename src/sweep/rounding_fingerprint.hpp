#pragma once

#include <string>

#include "lanes/instruction_set.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// What the last bits of a sweep's results depend on beside the program: the instruction set of its lanes, and what the
/// mathematical library and FFTW make of this processor. They choose their instructions by themselves, so their results
/// are asked: "avx2 or avx512, functions 5d2f0c1e". Runs with the same words give the same bits.
[[nodiscard]] std::string rounding_fingerprint(const Sweep& sweep, lanes::InstructionSet arch);

}  // namespace clatter::sweep
