#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "math/number.hpp"

namespace clatter {
inline namespace math {

/// Coefficients of a polynomial of degree 6 on [0, 1] in the Bernstein basis; the polynomial lies within their range.
template <class Number>
using Bernstein = std::array<Number, 7>;

/// Quintic Hermite interpolation of y, y', y'' at both ends of a step, its degree raised to 6, as Bernstein
/// coefficients minus the value at the beginning (eq. 12). A function with |y^(6)| <= M differs from it by at most M
/// step^6 / 14400 times the middle Bernstein function (eq. 13), so by a change of coefficient 3 alone.
template <class Number>
[[nodiscard]] Bernstein<Number> hermite(const Number& step, const Number& offset, const std::array<Number, 2>& first,
                                        const std::array<Number, 2>& second) {
  const Number v0 = step * first[0], v1 = step * first[1], a0 = step * step * second[0], a1 = step * step * second[1];
  const Number left = 2 * v0 / 5 + a0 / 20, right = offset - 2 * v1 / 5 + a1 / 20;
  return {Number(0), v0 / 6, v0 / 3 + a0 / 30, (left + right) / 2, offset - v1 / 3 + a1 / 30, offset - v1 / 6, offset};
}

/// The polynomial of degree 5 that has value and slope {y, y'} at both ends of a step and the values `thirds` at a
/// third and two thirds of it, as Bernstein coefficients, its degree raised by one.
[[nodiscard]] inline Bernstein<double> quintic(double step, const std::array<double, 2>& first,
                                               const std::array<double, 2>& last, const std::array<double, 2>& thirds) {
  const double b0 = first[0], b1 = b0 + step * first[1] / 5, b5 = last[0], b4 = b5 - step * last[1] / 5;
  const double left = (243 * thirds[0] - 32 * b0 - 80 * b1 - 10 * b4 - b5) / 40;   // 2 b2 + b3
  const double right = (243 * thirds[1] - b0 - 10 * b1 - 80 * b4 - 32 * b5) / 40;  // b2 + 2 b3
  const double b2 = (2 * left - right) / 3, b3 = (2 * right - left) / 3;
  return {b0, (b0 + 5 * b1) / 6, (b1 + 2 * b2) / 3, (b2 + b3) / 2, (2 * b3 + b4) / 3, (5 * b4 + b5) / 6, b5};
}

/// The polynomial of degree 3 that has value and slope {y, y'} at both ends of a step, its degree raised to 6.
[[nodiscard]] inline Bernstein<double> cubic(double step, const std::array<double, 2>& first,
                                             const std::array<double, 2>& last) {
  const double b0 = first[0], b1 = b0 + step * first[1] / 3, b3 = last[0], b2 = b3 - step * last[1] / 3;
  return {b0,
          (b0 + b1) / 2,
          (b0 + 3 * b1 + b2) / 5,
          (b0 + 9 * b1 + 9 * b2 + b3) / 20,
          (b1 + 3 * b2 + b3) / 5,
          (b2 + b3) / 2,
          b3};
}

/// Splits a polynomial at u (de Casteljau): returns the coefficients of the part before, the last of which is the value
/// at u; `c` becomes those of the part after.
[[nodiscard]] inline Bernstein<double> split_off(Bernstein<double>& c, double u) {
  Bernstein<double> before;
  for (std::size_t n = c.size(); n-- > 0;) {
    before[c.size() - 1 - n] = c[0];
    for (std::size_t i = 0; i < n; ++i) c[i] += u * (c[i + 1] - c[i]);
  }
  return before;
}

/// The value at u.
[[nodiscard]] inline double value_at(Bernstein<double> c, double u) { return split_off(c, u).back(); }

/// The uncertainty of the middle coefficient if step^6 |y^(6)| <= bound over the step (eq. 13).
template <class Number>
[[nodiscard]] Number hermite_error(const Number& bound) {
  return bound / 14400;
}

/// The middle Bernstein function of degree 6 at u.
template <class Number>
[[nodiscard]] Number middle_function(const Number& u) {
  const Number w = u * (1 - u);
  return 20 * w * w * w;
}

/// The first u in (0, 1], to rounding, at which a polynomial that begins at >= 0 becomes negative; roots at 0 don't
/// count.
template <class Number>
class FirstRoot {
 public:
  [[nodiscard]] static std::optional<Number> of(const Bernstein<Number>& c) { return search({c, 6}, 0); }

 private:
  struct Piece {
    Bernstein<Number> c;
    std::size_t degree;

    void divide_by_u() {
      for (std::size_t i = 0; i < degree; ++i)
        c[i] = c[i + 1] * static_cast<double>(degree) / static_cast<double>(i + 1);
      --degree;
    }
    /// Coefficients of (1 + t)^degree p(t/(1 + t)) by powers of t, which has p's roots and costs less to evaluate.
    [[nodiscard]] Bernstein<Number> by_powers() const {
      Bernstein<Number> q = c;
      double binomial = 1;
      for (std::size_t i = 0; i <= degree; ++i) {
        q[i] *= binomial;
        binomial *= static_cast<double>(degree - i) / static_cast<double>(i + 1);
      }
      return q;
    }
    /// The left half; this piece becomes the right one.
    [[nodiscard]] Piece split_off_left() {
      Piece left{*this};
      for (std::size_t n = degree; n >= 1; --n) {
        left.c[degree - n] = c[0];
        for (std::size_t i = 0; i < n; ++i) c[i] = (c[i] + c[i + 1]) / 2;
      }
      left.c[degree] = c[0];
      return left;
    }
  };

  /// The root in a piece whose coefficients change sign once: Newton's iteration within a bracket, counted from the end
  /// that is nearer.
  [[nodiscard]] static Number single(Piece p) {
    using std::abs, std::sqrt;
    const bool from_right = abs(p.c[p.degree]) < abs(p.c[0]);
    if (from_right) std::reverse(p.c.begin(), p.c.begin() + static_cast<std::ptrdiff_t>(p.degree) + 1);
    const Bernstein<Number> q = p.by_powers();
    const Number close =
        sqrt(epsilon<Number>()) / 8;  // the next iterate is exact to rounding: convergence is quadratic
    const bool falls = q[0] > 0;
    Number low = 0, high = std::numeric_limits<Number>::infinity(), t = -q[0] / q[1];
    if (!(t > 0 && t < 1)) t = Number(0.5);
    for (int iteration = 0; iteration < 200; ++iteration) {
      Number value = q[p.degree], slope = 0;
      for (std::size_t i = p.degree; i-- > 0;) slope = slope * t + value, value = value * t + q[i];
      ((value > 0) == falls ? low : high) = t;
      if (value == 0) break;
      Number next = t - value / slope;
      const bool newton = next > low && next < high;
      if (!newton) next = high < std::numeric_limits<Number>::infinity() ? Number((low + high) / 2) : Number(2 * t + 1);
      const bool settled = newton && abs(next - t) <= close * t;
      t = next;
      if (settled) break;
    }
    return (from_right ? Number(1) : t) / (1 + t);
  }

  [[nodiscard]] static std::optional<Number> search(Piece piece, int depth) {
    while (piece.degree > 0 && piece.c[0] == 0) piece.divide_by_u();  // the quotient has the same sign right of 0
    if (piece.degree == 0) return piece.c[0] < 0 ? std::optional<Number>(Number(0)) : std::nullopt;
    int changes = 0;
    bool negative = false;  // a coefficient of 0 counts as not negative
    for (std::size_t i = 0; i <= piece.degree; ++i)
      if ((piece.c[i] < 0) != negative) negative = !negative, ++changes;
    if (changes == 0) return std::nullopt;
    if (piece.c[0] < 0) return Number(0);
    if (changes == 1) return single(piece);
    if (depth == std::numeric_limits<Number>::digits) return Number(0);
    const Piece left = piece.split_off_left();
    if (const auto root = search(left, depth + 1)) return *root / 2;
    if (const auto root = search(piece, depth + 1)) return (1 + *root) / 2;
    return std::nullopt;
  }
};

}  // namespace math
}  // namespace clatter
