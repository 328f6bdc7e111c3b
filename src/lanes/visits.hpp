#pragma once

namespace clatter {

struct Lanes;

// One source file, compiled once for each instruction set.
void visit_sse2(Lanes& lanes);
void observe_sse2(Lanes& lanes);
void visit_avx2(Lanes& lanes);
void observe_avx2(Lanes& lanes);
void visit_avx512(Lanes& lanes);
void observe_avx512(Lanes& lanes);

}  // namespace clatter
