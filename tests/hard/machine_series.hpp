#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace clatter::hard::machine {

__extension__ typedef __float128 Quad;
/// Of libquadmath, whose header clang++ doesn't find.
extern "C" {
[[nodiscard]] Quad sinq(Quad) noexcept;
[[nodiscard]] Quad cosq(Quad) noexcept;
[[nodiscard]] Quad sqrtq(Quad) noexcept;
[[nodiscard]] Quad powq(Quad, Quad) noexcept;
[[nodiscard]] Quad acosq(Quad) noexcept;
[[nodiscard]] Quad floorq(Quad) noexcept;
}

// Polynomials of a step's part u, 0 ... 1.

inline constexpr std::size_t terms = 28;
template <class Real>
using SeriesOf = std::array<Real, terms>;
using Series = SeriesOf<Quad>;

[[nodiscard]] inline Quad number(std::size_t n) { return static_cast<Quad>(n); }
[[nodiscard]] inline Quad size_of(Quad value) { return value < 0 ? -value : value; }

/// In fewer digits, which take less time.
[[nodiscard]] inline SeriesOf<long double> rounded(const Series& p) {
  SeriesOf<long double> q{};
  for (std::size_t n = 0; n < terms; ++n) q[n] = static_cast<long double>(p[n]);
  return q;
}

/// Value and slope.
template <class Real>
[[nodiscard]] std::pair<Real, Real> jet(const SeriesOf<Real>& p, Real u) {
  Real value = 0, slope = 0;
  for (std::size_t k = terms; k-- > 0;) slope = slope * u + value, value = value * u + p[k];
  return {value, slope};
}

[[nodiscard]] inline Series slope_of(const Series& p) {
  Series slope{};
  for (std::size_t n = 0; n + 1 < terms; ++n) slope[n] = number(n + 1) * p[n + 1];
  return slope;
}
[[nodiscard]] inline Series sum_of(Series p, const Series& other) {
  for (std::size_t n = 0; n < terms; ++n) p[n] += other[n];
  return p;
}
[[nodiscard]] inline Series negative(Series p) {
  for (Quad& term : p) term = -term;
  return p;
}
/// The same polynomial by powers of the distance from u.
[[nodiscard]] inline Series about(Series p, Quad u) {
  for (std::size_t from = 0; from + 1 < terms; ++from)
    for (std::size_t n = terms - 1; n-- > from;) p[n] += u * p[n + 1];
  return p;
}
/// Over 0 ... u, in long double.
[[nodiscard]] inline long double integral_of_square(const Series& p, Quad u) {
  SeriesOf<long double> a{};
  Quad power = 1;
  for (std::size_t n = 0; n < terms; ++n) a[n] = static_cast<long double>(p[n] * power), power *= u;
  long double sum = 0;
  for (std::size_t degree = 2 * terms - 1; degree-- > 0;) {
    long double term = 0;
    for (std::size_t i = degree < terms ? 0 : degree - terms + 1; i < terms && i <= degree; ++i)
      term += a[i] * a[degree - i];
    sum += term / static_cast<long double>(degree + 1);
  }
  return sum * static_cast<long double>(u);
}

/// The only zero between a place where p is above 0 and one where it isn't, by Newton's steps that stay between these.
/// One as small as `close` is the last: each has about twice the digits of the one before.
template <class Real>
[[nodiscard]] Real refined(const SeriesOf<Real>& p, Real low, Real high, Real u, Real close) {
  for (int i = 0; i < 400 && u > low && u < high; ++i) {
    const auto [value, slope] = jet(p, u);
    (value > 0 ? low : high) = u;
    const Real newton = slope < 0 ? u - value / slope : low, off = newton - u;
    if (slope < 0 && off <= close * u && -off <= close * u) return newton;
    u = i < 40 && newton > low && newton < high ? newton : (low + high) / 2;
  }
  return u;
}
[[nodiscard]] inline Quad refined(const Series& p, Quad low, Quad high) {
  const auto from = static_cast<long double>(low), to = static_cast<long double>(high);
  const Quad near = refined<long double>(rounded(p), from, to, (from + to) / 2, 0x1p-40L);
  return refined<Quad>(p, low, high, near > low && near < high ? near : (low + high) / 2, Quad(0x1p-80));
}

/// The Bernstein coefficients of a polynomial on 0 ... 1.
template <class Real>
[[nodiscard]] SeriesOf<Real> bernstein(const SeriesOf<Real>& p) {
  static const auto shares = [] {
    std::array<SeriesOf<Real>, terms> table{};  // binomials (j, i)/(n, i)
    for (std::size_t j = 0; j < terms; ++j) {
      table[j][0] = 1;
      for (std::size_t i = 1; i <= j; ++i)
        table[j][i] = table[j][i - 1] * static_cast<Real>(j + 1 - i) / static_cast<Real>(terms - i);
    }
    return table;
  }();
  SeriesOf<Real> b{};
  for (std::size_t j = 0; j < terms; ++j)
    for (std::size_t i = 0; i <= j; ++i) b[j] += shares[j][i] * p[i];
  return b;
}

template <class Real>
[[nodiscard]] std::size_t changes_of(const SeriesOf<Real>& b) {
  std::size_t changes = 0;
  for (std::size_t j = 1; j < terms; ++j) changes += (b[j] > 0) != (b[j - 1] > 0);
  return changes;
}

/// The first fall to 0 within a part of the step, from the Bernstein coefficients there: no change of sign proves that
/// there is none, one that there is one. A graze within rounding is none.
[[nodiscard]] inline std::optional<Quad> fall_within(const Series& p, Series b, Quad low, Quad high) {
  const std::size_t changes = changes_of(b);
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
  if (p[0] > others) return std::nullopt;
  const SeriesOf<long double> b = bernstein(rounded(p));
  const auto unsure = static_cast<long double>(Quad(1e-16) * (others + p[0]));
  const bool is_sure = std::all_of(b.begin(), b.end(), [&](long double c) { return c > unsure || c < -unsure; });
  if (is_sure && changes_of(b) == 0) return std::nullopt;
  if (is_sure && changes_of(b) == 1) return refined(p, 0, 1);
  return fall_within(p, bernstein(p), 0, 1);
}

/// The zeros of the slope of p before an end.
[[nodiscard]] inline std::vector<Quad> turns_of(const Series& p, Quad end) {
  Series slope = slope_of(p);
  const auto first = std::find_if(slope.begin(), slope.end(), [](Quad term) { return term != 0; });
  if (first != slope.end() && *first < 0) slope = negative(slope);
  std::vector<Quad> turns;
  Quad at = 0;
  for (auto u = first_fall(slope); u && at + *u < end; u = first_fall(slope)) {
    turns.push_back(at += *u);
    slope = negative(about(slope, *u)), slope[0] = 0;
  }
  return turns;
}

}  // namespace clatter::hard::machine
