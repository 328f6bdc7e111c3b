#include "lanes/lane_effects.hpp"
#include "lanes/step_block.hpp"
#include "lanes/step_functions.hpp"

namespace clatter::lanes {

#if defined(__AVX512F__)
void step_unsprung_avx512(BlockState& lanes) { step_all<xsimd::avx512dq, unsprung, false>(lanes); }
void step_unsprung_observed_avx512(BlockState& lanes) { step_all<xsimd::avx512dq, unsprung, true>(lanes); }
#elif defined(__AVX2__)
void step_unsprung_avx2(BlockState& lanes) { step_all<xsimd::fma3<xsimd::avx2>, unsprung, false>(lanes); }
void step_unsprung_observed_avx2(BlockState& lanes) { step_all<xsimd::fma3<xsimd::avx2>, unsprung, true>(lanes); }
#else
void step_unsprung_sse2(BlockState& lanes) { step_all<xsimd::sse2, unsprung, false>(lanes); }
void step_unsprung_observed_sse2(BlockState& lanes) { step_all<xsimd::sse2, unsprung, true>(lanes); }
#endif

}  // namespace clatter::lanes
