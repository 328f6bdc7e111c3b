#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace clatter::hard::machine {

__extension__ typedef __float128 Quad;
/// Of libquadmath, whose header clang++ doesn't find.
extern "C" {
[[nodiscard]] Quad sinq(Quad) noexcept;
[[nodiscard]] Quad cosq(Quad) noexcept;
[[nodiscard]] Quad sqrtq(Quad) noexcept;
}

// Polynomials of a step's part u, 0 ... 1.

inline constexpr std::size_t terms = 28;
inline constexpr Quad rounding = Quad(0x1p-112);
using Series = std::array<Quad, terms>;

[[nodiscard]] inline Quad number(std::size_t n) { return static_cast<Quad>(n); }
[[nodiscard]] inline Quad size_of(Quad value) { return value < 0 ? -value : value; }

/// Value and slope.
[[nodiscard]] inline std::pair<Quad, Quad> jet(const Series& p, Quad u) {
  Quad value = 0, slope = 0;
  for (std::size_t k = terms; k-- > 0;) slope = slope * u + value, value = value * u + p[k];
  return {value, slope};
}

/// The only zero between a place where p is above 0 and one where it isn't, by Newton's steps that stay in between.
[[nodiscard]] inline Quad refined(const Series& p, Quad low, Quad high) {
  Quad u = (low + high) / 2;
  for (int i = 0; i < 400; ++i) {
    const auto [value, slope] = jet(p, u);
    (value > 0 ? low : high) = u;
    const Quad newton = slope < 0 ? u - value / slope : low;
    const Quad next = i < 40 && newton > low && newton < high ? newton : (low + high) / 2;
    if (size_of(next - u) <= rounding * u) return next;
    u = next;
  }
  return u;
}

/// The Bernstein coefficients of a polynomial on 0 ... 1.
[[nodiscard]] inline Series bernstein(const Series& p) {
  static const auto shares = [] {
    std::array<Series, terms> table{};  // binomials (j, i)/(n, i)
    for (std::size_t j = 0; j < terms; ++j) {
      table[j][0] = 1;
      for (std::size_t i = 1; i <= j; ++i) table[j][i] = table[j][i - 1] * number(j + 1 - i) / number(terms - i);
    }
    return table;
  }();
  Series b{};
  for (std::size_t j = 0; j < terms; ++j)
    for (std::size_t i = 0; i <= j; ++i) b[j] += shares[j][i] * p[i];
  return b;
}

/// The first fall to 0 within a part of the step, from the Bernstein coefficients there: no change of sign proves that
/// there is none, one that there is one. A graze within rounding is none.
[[nodiscard]] inline std::optional<Quad> fall_within(const Series& p, Series b, Quad low, Quad high) {
  std::size_t changes = 0;
  for (std::size_t j = 1; j < terms; ++j) changes += (b[j] > 0) != (b[j - 1] > 0);
  if (!(b[0] > 0)) return low;
  if (changes == 0) return std::nullopt;
  if (changes == 1) return refined(p, low, high);
  const Quad middle = (low + high) / 2;
  if (high - low < Quad(1e-30)) return std::nullopt;
  Series left{};
  for (std::size_t n = terms; n > 0; --n) {
    left[terms - n] = b[0];
    for (std::size_t j = 0; j + 1 < n; ++j) b[j] = (b[j] + b[j + 1]) / 2;
  }
  const auto before = fall_within(p, left, low, middle);
  return before ? before : fall_within(p, b, middle, high);
}

/// The first u at which p falls to 0; 0 if it starts below, or at exactly 0 and falls from there.
[[nodiscard]] inline std::optional<Quad> first_fall(Series p) {
  const auto first = std::find_if(p.begin(), p.end(), [](Quad term) { return term != 0; });
  if (first == p.end()) return std::nullopt;
  std::fill(std::copy(first, p.end(), p.begin()), p.end(), Quad(0));
  if (p[0] < 0) return Quad(0);
  Quad others = 0;
  for (std::size_t k = 1; k < terms; ++k) others += size_of(p[k]);
  return p[0] > others ? std::nullopt : fall_within(p, bernstein(p), 0, 1);
}

}  // namespace clatter::hard::machine
