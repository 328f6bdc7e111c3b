#include "lanes/kernel.hpp"
#include "lanes/visits.hpp"

namespace clatter {

#if defined(__AVX512F__)
void visit_avx512(Lanes& lanes) { visit_all<xsimd::avx512dq>(lanes); }
#elif defined(__AVX2__)
void visit_avx2(Lanes& lanes) { visit_all<xsimd::fma3<xsimd::avx2>>(lanes); }
#else
void visit_sse2(Lanes& lanes) { visit_all<xsimd::sse2>(lanes); }
#endif

}  // namespace clatter
