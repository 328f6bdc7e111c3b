#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "math/number.hpp"

namespace clatter {
inline namespace math {

namespace detail {

#if defined(__x86_64__)
inline const bool has_fused = __builtin_cpu_supports("fma");
#endif

/// x y + z in one rounding. The program is built for every x86-64, some of which have no instruction for it, and a call
/// of std::fma costs as much as the rest of a product.
[[nodiscard]] inline double fused(double x, double y, double z) {
#if defined(__x86_64__)
  if (has_fused) {
    asm("vfmadd213sd %2, %1, %0" : "+x"(x) : "x"(y), "x"(z));
    return x;
  }
#endif
  return std::fma(x, y, z);
}

}  // namespace detail

/// A number of some 31 decimal digits, the unevaluated sum of two doubles of which the second is at most half an ulp of
/// the first (Dekker 1971). It takes a tenth of the time of a number of 50 digits. Its sums, products, quotients and
/// functions are off by a few 1e-32 of their values, as long as these are between 1e-280 and 1e300.
class DoubleDouble {
 public:
  constexpr DoubleDouble() = default;
  template <class T>
  requires std::is_arithmetic_v<T>
  constexpr DoubleDouble(T value) : high_(static_cast<double>(value)) {}  // every int is a double
  /// The sum of two doubles.
  [[nodiscard]] static DoubleDouble sum(double a, double b) {
    const DoubleDouble s = exact_sum(a, b);
    return std::isfinite(s.high_) ? s : DoubleDouble(s.high_);
  }
  /// The product of two doubles.
  [[nodiscard]] static DoubleDouble product(double a, double b) {
    const DoubleDouble p = exact_product(a, b);
    return std::isfinite(p.high_) ? p : DoubleDouble(p.high_);
  }
  /// The sum of two numbers of which the second is so much smaller that no digit of the first is cancelled.
  [[nodiscard]] static DoubleDouble sum_of_unlike(const DoubleDouble& large, const DoubleDouble& small) {
    const DoubleDouble highs = joined(large.high_, small.high_);
    return joined(highs.high_, highs.low_ + (large.low_ + small.low_));
  }

  [[nodiscard]] constexpr double high() const { return high_; }
  [[nodiscard]] constexpr double low() const { return low_; }
  template <class T>
  requires std::is_arithmetic_v<T>
  explicit constexpr operator T() const { return static_cast<T>(high_); }

  DoubleDouble operator-() const { return {-high_, -low_}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble highs = exact_sum(a.high_, b.high_), lows = exact_sum(a.low_, b.low_);
    const DoubleDouble near = joined(highs.high_, highs.low_ + lows.high_);
    return finite(joined(near.high_, near.low_ + lows.low_), highs.high_);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = exact_product(a.high_, b.high_);
    return finite(joined(p.high_, p.low_ + (a.high_ * b.low_ + a.low_ * b.high_)), p.high_);
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high_ / b.high_;
    if (!std::isfinite(first) || !std::isfinite(b.high_)) return first;
    DoubleDouble left = a - b * first;
    const double second = left.high_ / b.high_;
    left = left - b * second;
    const DoubleDouble near = joined(first, second);
    return finite(joined(near.high_, near.low_ + left.high_ / b.high_), first);
  }
  DoubleDouble& operator+=(const DoubleDouble& other) { return *this = *this + other; }
  DoubleDouble& operator-=(const DoubleDouble& other) { return *this = *this - other; }
  DoubleDouble& operator*=(const DoubleDouble& other) { return *this = *this * other; }
  DoubleDouble& operator/=(const DoubleDouble& other) { return *this = *this / other; }

  friend constexpr bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high_ == b.high_ && a.low_ == b.low_;
  }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ < b.low_);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ <= b.low_);
  }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }

 private:
  constexpr DoubleDouble(double high, double low) : high_(high), low_(low) {}
  // Where a double overflows the second part of these is NaN, and so is all that is computed from it.
  static DoubleDouble exact_sum(double a, double b) {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  static DoubleDouble exact_product(double a, double b) {
    const double p = a * b;
    return {p, detail::fused(a, b, -p)};
  }
  /// The sum of two doubles of which the first is the larger, or 0.
  static DoubleDouble joined(double large, double small) {
    const double s = large + small;
    return {s, small - (s - large)};
  }
  /// A result, or the double that takes its place if it is not finite.
  static DoubleDouble finite(const DoubleDouble& result, double otherwise) {
    return std::isfinite(result.high_) ? result : DoubleDouble(otherwise);
  }

  double high_ = 0.0, low_ = 0.0;
};

[[nodiscard]] inline bool isfinite(const DoubleDouble& x) { return std::isfinite(x.high()); }
[[nodiscard]] inline bool isnan(const DoubleDouble& x) { return std::isnan(x.high()); }
[[nodiscard]] inline DoubleDouble abs(const DoubleDouble& x) { return std::signbit(x.high()) ? -x : x; }
[[nodiscard]] inline DoubleDouble fma(const DoubleDouble& x, const DoubleDouble& y, const DoubleDouble& z) {
  return x * y + z;
}
[[nodiscard]] inline DoubleDouble ldexp(const DoubleDouble& x, int exponent) {
  return DoubleDouble::sum(std::ldexp(x.high(), exponent), std::ldexp(x.low(), exponent));
}
[[nodiscard]] inline DoubleDouble floor(const DoubleDouble& x) {
  const double high = std::floor(x.high());
  return high == x.high() ? DoubleDouble::sum(high, std::floor(x.low())) : DoubleDouble(high);
}

/// One step of Newton's method from the root of the first double.
[[nodiscard]] inline DoubleDouble sqrt(const DoubleDouble& x) {
  const double root = std::sqrt(x.high());
  if (root == 0 || !std::isfinite(root)) return root;
  return DoubleDouble::sum(root, (x - DoubleDouble::product(root, root)).high() / (2 * root));
}

namespace detail {

inline const DoubleDouble ln_two = DoubleDouble::sum(0.6931471805599453, 2.3190468138462996e-17);

/// [n]: 1/n!
[[nodiscard]] inline const std::array<DoubleDouble, 30>& inverse_factorials() {
  static const auto values = [] {
    std::array<DoubleDouble, 30> inverse{DoubleDouble(1)};
    for (std::size_t i = 1; i < inverse.size(); ++i) inverse[i] = inverse[i - 1] / DoubleDouble(i);
    return inverse;
  }();
  return values;
}

/// The sum of y^j/(first + apart j)! over all j, |y| <= 1. From `terms` on they count so little that double has digits
/// enough.
template <std::size_t first, std::size_t apart, std::size_t terms, std::size_t rest>
[[nodiscard]] inline DoubleDouble power_series(const DoubleDouble& y) {
  const auto& inverse = inverse_factorials();
  double last = 0;
  for (std::size_t j = terms + rest; j-- > terms;) last = last * y.high() + inverse[first + apart * j].high();
  DoubleDouble sum = last;
  for (std::size_t j = terms; j-- > 0;) sum = DoubleDouble::sum_of_unlike(inverse[first + apart * j], sum * y);
  return sum;
}

/// sin x (first = 1) or cos x (0) by its series, |x| <= pi/4. The terms of either sign are summed apart, since a
/// processor computes two sums at once.
template <std::size_t first>
[[nodiscard]] DoubleDouble alternating_series(const DoubleDouble& x) {
  const DoubleDouble square = x * x, fourth = square * square;
  const DoubleDouble more = power_series<first, 4, 5 - first, 3>(fourth);
  const DoubleDouble less = square * power_series<first + 2, 4, 4, 3>(fourth);
  const DoubleDouble sum = DoubleDouble::sum_of_unlike(more, -less);
  return first == 1 ? x * sum : sum;
}

/// An angle less the nearest multiple of pi/2, and that multiple modulo 4.
struct Quarter {
  DoubleDouble rest;
  int number;
};
[[nodiscard]] inline Quarter quarter_of(const DoubleDouble& angle) {
  // pi/2 in three parts, so that the rest has all digits up to 1e6
  constexpr double first = 1.5707963267948966, second = 6.123233995736766e-17, third = -1.4973849048591833e-33;
  const double n = std::nearbyint(angle.high() / first);
  if (n == 0) return {angle, 0};
  const DoubleDouble rest =
      angle - DoubleDouble::product(n, first) - DoubleDouble::product(n, second) - DoubleDouble(n * third);
  return {rest, static_cast<int>(n - 4 * std::floor(n / 4))};
}

/// e^x - 1 for |x| <= 0.35: of x/2^6 by its series, then doubled six times.
[[nodiscard]] inline DoubleDouble small_expm1(const DoubleDouble& x) {
  constexpr int doublings = 6;
  const DoubleDouble part = ldexp(x, -doublings);
  DoubleDouble sum = part * power_series<1, 1, 6, 5>(part);
  for (int i = 0; i < doublings; ++i) sum = sum * DoubleDouble::sum_of_unlike(2, sum);
  return sum;
}

}  // namespace detail

[[nodiscard]] inline DoubleDouble sin(const DoubleDouble& x) {
  const auto [rest, number] = detail::quarter_of(x);
  const DoubleDouble value =
      number % 2 == 0 ? detail::alternating_series<1>(rest) : detail::alternating_series<0>(rest);
  return number < 2 ? value : -value;
}
[[nodiscard]] inline DoubleDouble cos(const DoubleDouble& x) {
  const auto [rest, number] = detail::quarter_of(x);
  const DoubleDouble value =
      number % 2 == 0 ? detail::alternating_series<0>(rest) : detail::alternating_series<1>(rest);
  return number == 0 || number == 3 ? value : -value;
}
[[nodiscard]] inline DoubleDouble tan(const DoubleDouble& x) { return sin(x) / cos(x); }

[[nodiscard]] inline DoubleDouble exp(const DoubleDouble& x) {
  const double whole = std::exp(x.high());
  if (whole == 0 || !std::isfinite(whole)) return whole;
  const double n = std::nearbyint(x.high() / detail::ln_two.high());
  return ldexp(detail::small_expm1(x - n * detail::ln_two) + 1, static_cast<int>(n));
}
[[nodiscard]] inline DoubleDouble expm1(const DoubleDouble& x) {
  return std::abs(x.high()) < 0.35 ? detail::small_expm1(x) : exp(x) - 1;
}
/// By the logarithm of the first double, and the series of what is left.
[[nodiscard]] inline DoubleDouble log(const DoubleDouble& x) {
  const double near = std::log(x.high());
  if (!std::isfinite(near)) return near;
  const DoubleDouble left = x * exp(-DoubleDouble(near)) - 1;
  return near + (left - left * left / 2);
}
[[nodiscard]] inline DoubleDouble log1p(const DoubleDouble& x) {
  const double near = std::log1p(x.high());
  if (!std::isfinite(near)) return near;
  const DoubleDouble left = (x - expm1(DoubleDouble(near))) * exp(-DoubleDouble(near));
  return near + (left - left * left / 2);
}
[[nodiscard]] inline DoubleDouble pow(const DoubleDouble& x, const DoubleDouble& y) { return exp(y * log(x)); }
/// By the angle of the first doubles, from which the tangent of what is left is no more than rounding.
[[nodiscard]] inline DoubleDouble atan2(const DoubleDouble& y, const DoubleDouble& x) {
  const double near = std::atan2(y.high(), x.high());
  const DoubleDouble s = sin(DoubleDouble(near)), c = cos(DoubleDouble(near)), along = x * c + y * s;
  return along == 0 || !isfinite(along) ? DoubleDouble(near) : near + (y * c - x * s) / along;
}
[[nodiscard]] inline DoubleDouble atan(const DoubleDouble& x) { return atan2(x, DoubleDouble(1)); }
[[nodiscard]] inline DoubleDouble hypot(const DoubleDouble& x, const DoubleDouble& y) { return norm(x, y); }

}  // namespace math
}  // namespace clatter

template <>
class std::numeric_limits<clatter::DoubleDouble> {
 public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr bool has_infinity = true, has_quiet_NaN = true;
  static constexpr int digits = 104, digits10 = 31, max_digits10 = 33, radix = 2;
  static constexpr int min_exponent = std::numeric_limits<double>::min_exponent + 53;
  static constexpr int max_exponent = std::numeric_limits<double>::max_exponent;
  static constexpr clatter::DoubleDouble epsilon() { return 4.930380657631324e-32; }  // 2^-104
  static constexpr clatter::DoubleDouble min() { return 2.0041683600089728e-292; }    // 2^-969
  static constexpr clatter::DoubleDouble max() { return std::numeric_limits<double>::max(); }
  static constexpr clatter::DoubleDouble lowest() { return -std::numeric_limits<double>::max(); }
  static constexpr clatter::DoubleDouble infinity() { return std::numeric_limits<double>::infinity(); }
  static constexpr clatter::DoubleDouble quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
};
