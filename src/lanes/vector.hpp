#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "math/number.hpp"

namespace clatter::lanes {

template <class A>
struct PairMask;

/// Two SIMD vectors side by side, so that the operations of one fill the latency of the other's. A number type of the
/// physics: each lane is a number of its own.
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
  friend Pair operator-(const Pair& x) { return {-x.first, -x.second}; }
};

/// Lanes of a pair for which something holds.
template <class A>
struct PairMask {
  using Batch = xsimd::batch_bool<double, A>;
  Batch first, second;

  friend PairMask operator&(const PairMask& x, const PairMask& y) {
    return {both(x.first, y.first), both(x.second, y.second)};
  }
  friend PairMask operator|(const PairMask& x, const PairMask& y) {
    return {either(x.first, y.first), either(x.second, y.second)};
  }
  friend PairMask operator!(const PairMask& x) { return {inverse(x.first), inverse(x.second)}; }
  /// The lanes of x that aren't in y.
  friend PairMask operator-(const PairMask& x, const PairMask& y) {
    return {without(x.first, y.first), without(x.second, y.second)};
  }

 private:
  // AVX-512: xsimd's operators are those of integers, for which masks travel through general registers.
  static constexpr bool in_mask_register = sizeof(typename Batch::register_type) == 1;

  static Batch both(const Batch& x, const Batch& y) {
#ifdef __AVX512DQ__
    if constexpr (in_mask_register) return Batch(_kand_mask8(x.data, y.data));
#endif
    return x & y;
  }
  static Batch either(const Batch& x, const Batch& y) {
#ifdef __AVX512DQ__
    if constexpr (in_mask_register) return Batch(_kor_mask8(x.data, y.data));
#endif
    return x | y;
  }
  static Batch without(const Batch& x, const Batch& y) {
#ifdef __AVX512DQ__
    if constexpr (in_mask_register) return Batch(_kandn_mask8(y.data, x.data));
#endif
    return x & !y;
  }
  static Batch inverse(const Batch& x) {
#ifdef __AVX512DQ__
    if constexpr (in_mask_register) return Batch(_knot_mask8(x.data));
#endif
    return !x;
  }
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

// The rest of a number type (math/number.hpp). xsimd 8.1 has no fused multiplication and addition for AVX-512.

template <class A>
xsimd::batch<double, A> mul_add(const xsimd::batch<double, A>& x, const xsimd::batch<double, A>& y,
                                const xsimd::batch<double, A>& z) {
#ifdef __AVX512F__
  if constexpr (xsimd::batch<double, A>::size == 8) return _mm512_fmadd_pd(x, y, z);
#endif
  return xsimd::fma(x, y, z);
}
template <class A>
xsimd::batch<double, A> mul_sub(const xsimd::batch<double, A>& x, const xsimd::batch<double, A>& y,
                                const xsimd::batch<double, A>& z) {
#ifdef __AVX512F__
  if constexpr (xsimd::batch<double, A>::size == 8) return _mm512_fmsub_pd(x, y, z);
#endif
  return xsimd::fms(x, y, z);
}
template <class A>
xsimd::batch<double, A> neg_mul_add(const xsimd::batch<double, A>& x, const xsimd::batch<double, A>& y,
                                    const xsimd::batch<double, A>& z) {
#ifdef __AVX512F__
  if constexpr (xsimd::batch<double, A>::size == 8) return _mm512_fnmadd_pd(x, y, z);
#endif
  return xsimd::fnma(x, y, z);
}
template <class A>
Pair<A> mul_add(const Pair<A>& x, const Pair<A>& y, const Pair<A>& z) {
  return {mul_add(x.first, y.first, z.first), mul_add(x.second, y.second, z.second)};
}
template <class A>
Pair<A> mul_sub(const Pair<A>& x, const Pair<A>& y, const Pair<A>& z) {
  return {mul_sub(x.first, y.first, z.first), mul_sub(x.second, y.second, z.second)};
}
template <class A>
Pair<A> neg_mul_add(const Pair<A>& x, const Pair<A>& y, const Pair<A>& z) {
  return {neg_mul_add(x.first, y.first, z.first), neg_mul_add(x.second, y.second, z.second)};
}
template <class A>
Pair<A> lesser(const Pair<A>& x, const Pair<A>& y) {
  return {xsimd::min(x.first, y.first), xsimd::min(x.second, y.second)};
}
template <class A>
Pair<A> greater(const Pair<A>& x, const Pair<A>& y) {
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

/// A bit for each lane.
template <class A>
unsigned bits(const xsimd::batch_bool<double, A>& m) {
  if constexpr (sizeof(m.data) == 1)
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
template <class A>
bool any(const PairMask<A>& m) {
  return xsimd::any(m.first | m.second);
}
/// The number of lanes in a mask.
template <class A>
int count(const PairMask<A>& m) {
  return __builtin_popcount(bits(m));
}

}  // namespace clatter::lanes

template <class A>
struct clatter::MaskOf<clatter::lanes::Pair<A>> {
  using type = clatter::lanes::PairMask<A>;
};
