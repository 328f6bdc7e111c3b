#include "lanes/step_block.hpp"
#include "lanes/lane_effects.hpp"
#include "lanes/step_functions.hpp"

namespace clatter::lanes {

#if defined(__AVX512F__)
void step_avx512(BlockState& lanes) { step_all<xsimd::avx512dq, sprung, false>(lanes); }
void step_observed_avx512(BlockState& lanes) { step_all<xsimd::avx512dq, sprung, true>(lanes); }
#elif defined(__AVX2__)
void step_avx2(BlockState& lanes) { step_all<xsimd::fma3<xsimd::avx2>, sprung, false>(lanes); }
void step_observed_avx2(BlockState& lanes) { step_all<xsimd::fma3<xsimd::avx2>, sprung, true>(lanes); }
#else
void step_sse2(BlockState& lanes) { step_all<xsimd::sse2, sprung, false>(lanes); }
void step_observed_sse2(BlockState& lanes) { step_all<xsimd::sse2, sprung, true>(lanes); }
#endif

}  // namespace clatter::lanes
