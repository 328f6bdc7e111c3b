#pragma once

namespace clatter::lanes {

struct BlockState;

// One source file, compiled once for each instruction set.
void step_sse2(BlockState& lanes);
void step_observed_sse2(BlockState& lanes);
void step_avx2(BlockState& lanes);
void step_observed_avx2(BlockState& lanes);
void step_avx512(BlockState& lanes);
void step_observed_avx512(BlockState& lanes);

}  // namespace clatter::lanes
