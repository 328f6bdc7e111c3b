#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace clatter::hard {

/// A polynomial in long double, by ascending powers.
inline constexpr std::size_t series_terms = 28;
using Series = std::array<long double, series_terms>;

[[nodiscard]] inline long double value_of(const Series& p, long double u) {
  long double y = 0;
  for (std::size_t k = series_terms; k-- > 0;) y = y * u + p[k];
  return y;
}

[[nodiscard]] inline Series derivative_of(const Series& p) {
  Series q{};
  for (std::size_t k = 1; k < series_terms; ++k) q[k - 1] = static_cast<long double>(k) * p[k];
  return q;
}

namespace detail {

/// The same polynomial by powers of the distance from u.
[[nodiscard]] inline Series about(Series p, long double u) {
  for (std::size_t from = 0; from + 1 < series_terms; ++from)
    for (std::size_t k = series_terms - 1; k-- > from;) p[k] += u * p[k + 1];
  return p;
}

/// The most by which the terms from a power on move p within a radius, over the radius to a power.
[[nodiscard]] inline long double tail(const Series& p, std::size_t from, long double radius) {
  long double sum = 0;
  for (std::size_t k = series_terms; k-- > from;) sum = sum * radius + std::abs(p[k]);
  return sum * radius;
}

/// Halves an interval at whose ends p is above 0 and no more, down to the rounding of u.
[[nodiscard]] inline long double bisected(const Series& p, long double low, long double high) {
  for (int i = 0; i < 200; ++i) {
    const long double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) break;
    (value_of(p, middle) > 0 ? low : high) = middle;
  }
  return high;
}

/// The first u in an interval at which p isn't above 0. Parts without a zero, then parts on which p is monotonic, are
/// proved by the terms beyond the first; all others are halved, down to a graze within rounding.
[[nodiscard]] inline std::optional<long double> first_fall(const Series& p, long double low, long double high) {
  const long double middle = low + (high - low) / 2, radius = (high - low) / 2;
  const Series near = about(p, middle);
  if (std::abs(near[0]) > tail(near, 1, radius)) return near[0] > 0 ? std::nullopt : std::optional(low);
  const long double others = tail(derivative_of(near), 1, radius);
  if (std::abs(near[1]) > others || !(middle > low && middle < high) || radius < 1e-19L) {
    if (!(value_of(p, low) > 0)) return low;
    return value_of(p, high) > 0 ? std::nullopt : std::optional(bisected(p, low, high));
  }
  const auto before = first_fall(p, low, middle);
  return before ? before : first_fall(p, middle, high);
}

}  // namespace detail

/// The first u, 0 ... 1, at which a polynomial that starts above 0 has fallen to 0; nothing if it doesn't. A start at
/// exactly 0 counts as above if it rises from there, else the answer is 0.
[[nodiscard]] inline std::optional<long double> first_fall(Series p) {
  std::size_t zeros = 0;
  while (zeros < series_terms && p[zeros] == 0) ++zeros;
  if (zeros == series_terms) return std::nullopt;
  for (std::size_t k = 0; k < series_terms; ++k) p[k] = k + zeros < series_terms ? p[k + zeros] : 0;
  if (p[0] < 0) return 0;
  return detail::first_fall(p, 0, 1);
}

}  // namespace clatter::hard
