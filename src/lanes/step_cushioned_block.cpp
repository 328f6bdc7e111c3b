#include "lanes/lane_effects.hpp"
#include "lanes/step_block.hpp"
#include "lanes/step_functions.hpp"

namespace clatter::lanes {

#if defined(__AVX512F__)
void step_cushioned_avx512(BlockState& lanes) { step_all<xsimd::avx512dq, cushioned, false>(lanes); }
#elif defined(__AVX2__)
void step_cushioned_avx2(BlockState& lanes) { step_all<xsimd::fma3<xsimd::avx2>, cushioned, false>(lanes); }
#else
void step_cushioned_sse2(BlockState& lanes) { step_all<xsimd::sse2, cushioned, false>(lanes); }
#endif

}  // namespace clatter::lanes
