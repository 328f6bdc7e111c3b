// Compiled once for each instruction set, which CLATTER_SINCOS_ARCH names, with a namespace of its own for xsimd in
// each: of inline functions without the instruction set in their type the linker would keep only one, perhaps one whose
// instructions this machine doesn't have.
#define CLATTER_JOINED(a, b) a##b
#define CLATTER_JOIN(a, b) CLATTER_JOINED(a, b)
#define xsimd CLATTER_JOIN(xsimd_, CLATTER_SINCOS_ARCH)
#include "bench/sincos.hpp"

#include <xsimd/xsimd.hpp>

namespace clatter::bench {
namespace {

/// xsimd's name of an instruction set.
template <lanes::InstructionSet arch>
struct Named;
template <>
struct Named<lanes::InstructionSet::sse2> {
  using Type = xsimd::sse2;
};
template <>
struct Named<lanes::InstructionSet::avx2> {
  using Type = xsimd::fma3<xsimd::avx2>;
};
template <>
struct Named<lanes::InstructionSet::avx512> {
  using Type = xsimd::avx512dq;
};

}  // namespace

template <lanes::InstructionSet arch>
void sincos(Sines& of) {
  using Batch = xsimd::batch<double, typename Named<arch>::Type>;
  for (std::size_t i = 0; i < Sines::count; i += Batch::size) {
    const auto [sine, cosine] = xsimd::sincos(Batch::load_aligned(of.angles + i));
    sine.store_aligned(of.sines + i), cosine.store_aligned(of.cosines + i);
  }
}

template void sincos<lanes::InstructionSet::CLATTER_SINCOS_ARCH>(Sines&);

}  // namespace clatter::bench
