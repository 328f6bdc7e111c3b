#pragma once

#include <vector>

#include "lanes/instruction_set.hpp"

namespace clatter::bench {

/// The instruction sets of this machine, scalar first.
[[nodiscard]] std::vector<lanes::InstructionSet> archs_here();

/// Adds the unit of times as benchmarks of their own, "sincos/sse2" and so on for each instruction set of this machine:
/// one batched xsimd sincos for each element, the counter `time`.
void add_unit();

/// Adds the unit and runs all benchmarks; returns the exit code of main.
int run_benchmarks(int count, char** arguments);

}  // namespace clatter::bench
