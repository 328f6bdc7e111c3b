#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

namespace clatter::lanes {

template <class A>
struct PairMask;

/// Two SIMD vectors side by side, so that the operations of one fill the latency of the other's.
template <class A>
struct Pair {
  using Mask = PairMask<A>;
  using Batch = xsimd::batch<double, A>;
  static constexpr std::size_t size = 2 * Batch::size;

  Batch first, second;

  Pair() = default;
  Pair(const Batch& a, const Batch& b) : first(a), second(b) {}
  explicit Pair(double y) : first(y), second(y) {}
  static Pair load(const double* from) { return {Batch::load_aligned(from), Batch::load_aligned(from + Batch::size)}; }
  void store(double* to) const { first.store_aligned(to), second.store_aligned(to + Batch::size); }

  friend Pair operator+(const Pair& x, const Pair& y) { return {x.first + y.first, x.second + y.second}; }
  friend Pair operator-(const Pair& x, const Pair& y) { return {x.first - y.first, x.second - y.second}; }
  friend Pair operator*(const Pair& x, const Pair& y) { return {x.first * y.first, x.second * y.second}; }
  friend Pair operator/(const Pair& x, const Pair& y) { return {x.first / y.first, x.second / y.second}; }
  friend Pair operator*(const Pair& x, double y) { return x * Pair(y); }
  friend Pair operator-(const Pair& x) { return {-x.first, -x.second}; }
};

/// Lanes of a pair for which something holds.
template <class A>
struct PairMask {
  using Batch = xsimd::batch_bool<double, A>;
  Batch first, second;

  friend PairMask operator&(const PairMask& x, const PairMask& y) { return {x.first & y.first, x.second & y.second}; }
  friend PairMask operator|(const PairMask& x, const PairMask& y) { return {x.first | y.first, x.second | y.second}; }
  friend PairMask operator!(const PairMask& x) { return {!x.first, !x.second}; }
};

template <class A>
PairMask<A> operator<(const Pair<A>& x, const Pair<A>& y) {
  return {x.first < y.first, x.second < y.second};
}
template <class A>
PairMask<A> operator<=(const Pair<A>& x, const Pair<A>& y) {
  return {x.first <= y.first, x.second <= y.second};
}
template <class A>
PairMask<A> operator>(const Pair<A>& x, const Pair<A>& y) {
  return {x.first > y.first, x.second > y.second};
}
template <class A>
PairMask<A> operator>=(const Pair<A>& x, const Pair<A>& y) {
  return {x.first >= y.first, x.second >= y.second};
}

// xsimd 8.1 has no fused multiplication and addition for AVX-512.

/// x y + z, in one rounding if the instruction set has it.
template <class A>
xsimd::batch<double, A> fma(const xsimd::batch<double, A>& x, const xsimd::batch<double, A>& y,
                            const xsimd::batch<double, A>& z) {
#ifdef __AVX512F__
  if constexpr (xsimd::batch<double, A>::size == 8) return _mm512_fmadd_pd(x, y, z);
#endif
  return xsimd::fma(x, y, z);
}
/// x y - z
template <class A>
xsimd::batch<double, A> fms(const xsimd::batch<double, A>& x, const xsimd::batch<double, A>& y,
                            const xsimd::batch<double, A>& z) {
#ifdef __AVX512F__
  if constexpr (xsimd::batch<double, A>::size == 8) return _mm512_fmsub_pd(x, y, z);
#endif
  return xsimd::fms(x, y, z);
}
/// z - x y
template <class A>
xsimd::batch<double, A> fnma(const xsimd::batch<double, A>& x, const xsimd::batch<double, A>& y,
                             const xsimd::batch<double, A>& z) {
#ifdef __AVX512F__
  if constexpr (xsimd::batch<double, A>::size == 8) return _mm512_fnmadd_pd(x, y, z);
#endif
  return xsimd::fnma(x, y, z);
}
template <class A>
Pair<A> fma(const Pair<A>& x, const Pair<A>& y, const Pair<A>& z) {
  return {fma(x.first, y.first, z.first), fma(x.second, y.second, z.second)};
}
template <class A>
Pair<A> fms(const Pair<A>& x, const Pair<A>& y, const Pair<A>& z) {
  return {fms(x.first, y.first, z.first), fms(x.second, y.second, z.second)};
}
template <class A>
Pair<A> fnma(const Pair<A>& x, const Pair<A>& y, const Pair<A>& z) {
  return {fnma(x.first, y.first, z.first), fnma(x.second, y.second, z.second)};
}
template <class A>
Pair<A> min(const Pair<A>& x, const Pair<A>& y) {
  return {xsimd::min(x.first, y.first), xsimd::min(x.second, y.second)};
}
template <class A>
Pair<A> max(const Pair<A>& x, const Pair<A>& y) {
  return {xsimd::max(x.first, y.first), xsimd::max(x.second, y.second)};
}
template <class A>
Pair<A> abs(const Pair<A>& x) {
  return {xsimd::abs(x.first), xsimd::abs(x.second)};
}
template <class A>
Pair<A> select(const PairMask<A>& m, const Pair<A>& x, const Pair<A>& y) {
  return {xsimd::select(m.first, x.first, y.first), xsimd::select(m.second, x.second, y.second)};
}
template <class A>
bool any(const PairMask<A>& m) {
  return xsimd::any(m.first | m.second);
}
/// A bit for each lane.
template <class A>
unsigned bits(const xsimd::batch_bool<double, A>& m) {
  if constexpr (requires {
                  static_cast<unsigned>(m.data);
                  requires sizeof(m.data) == 1;
                })
    return m.data;
  else if constexpr (xsimd::batch<double, A>::size == 4)
    return static_cast<unsigned>(_mm256_movemask_pd(m.data));
  else
    return static_cast<unsigned>(_mm_movemask_pd(m.data));
}
template <class A>
unsigned bits(const PairMask<A>& m) {
  return bits(m.first) | bits(m.second) << xsimd::batch<double, A>::size;
}

/// The number of lanes in a mask.
template <class A>
int count(const PairMask<A>& m) {
  return __builtin_popcount(bits(m));
}

}  // namespace clatter::lanes
