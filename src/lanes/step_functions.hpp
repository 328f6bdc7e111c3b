#pragma once

namespace clatter::lanes {

struct BlockState;

// One source file for each set of effects (lane_effects.hpp), compiled once for each instruction set.
void step_sse2(BlockState& lanes);
void step_observed_sse2(BlockState& lanes);
void step_avx2(BlockState& lanes);
void step_observed_avx2(BlockState& lanes);
void step_avx512(BlockState& lanes);
void step_observed_avx512(BlockState& lanes);

void step_unsprung_sse2(BlockState& lanes);
void step_unsprung_observed_sse2(BlockState& lanes);
void step_unsprung_avx2(BlockState& lanes);
void step_unsprung_observed_avx2(BlockState& lanes);
void step_unsprung_avx512(BlockState& lanes);
void step_unsprung_observed_avx512(BlockState& lanes);

void step_cushioned_sse2(BlockState& lanes);
void step_cushioned_avx2(BlockState& lanes);
void step_cushioned_avx512(BlockState& lanes);

}  // namespace clatter::lanes
