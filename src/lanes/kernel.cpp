#include "lanes/visit.hpp"
#include "lanes/visits.hpp"

namespace clatter {

#if defined(__AVX512F__)
void visit_avx512(Lanes& lanes) { visit_all<xsimd::avx512dq, false>(lanes); }
void observe_avx512(Lanes& lanes) { visit_all<xsimd::avx512dq, true>(lanes); }
#elif defined(__AVX2__)
void visit_avx2(Lanes& lanes) { visit_all<xsimd::fma3<xsimd::avx2>, false>(lanes); }
void observe_avx2(Lanes& lanes) { visit_all<xsimd::fma3<xsimd::avx2>, true>(lanes); }
#else
void visit_sse2(Lanes& lanes) { visit_all<xsimd::sse2, false>(lanes); }
void observe_sse2(Lanes& lanes) { visit_all<xsimd::sse2, true>(lanes); }
#endif

}  // namespace clatter
