#pragma once

#include <string>

#include "lanes/instruction_set.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Identifies everything besides the program that the last bits of a sweep's results depend on: the instruction set of
/// its lanes, and the rounding of the mathematical library and FFTW on this processor. These choose their instructions
/// by themselves, so a digest of their results stands for them: "avx2 or avx512, functions 5d2f0c1e". Runs with the
/// same fingerprint give the same bits.
[[nodiscard]] std::string rounding_fingerprint(const Sweep& sweep, lanes::InstructionSet arch);

}  // namespace clatter::sweep
