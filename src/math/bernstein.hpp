#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "math/number.hpp"

namespace clatter {
inline namespace math {

/// Coefficients of a polynomial on [0, 1] in the Bernstein basis, of degree 6 unless another one is given; the
/// polynomial lies within their range.
template <class Number, std::size_t degree = 6>
using Bernstein = std::array<Number, degree + 1>;

/// A function at both ends of a step: its value, and its first and second derivative by the part of the step.
template <class Number>
struct HermiteData {
  Number y0, v0, a0, y1, v1, a1;

  /// The same with derivatives by a time of which the step lasts `step`.
  [[nodiscard]] static HermiteData over(const Number& step, const HermiteData& e) {
    const Number square = step * step;
    return {e.y0, e.v0 * step, e.a0 * square, e.y1, e.v1 * step, e.a1 * square};
  }
};

/// Quintic Hermite interpolation of y, y', y'' at both ends of a step, its degree raised to 6, as Bernstein
/// coefficients (eq. 12). A function with |y^(6)| <= M differs from it by at most M step^6 / 14400 times the middle
/// Bernstein function (eq. 13), so by a change of coefficient 3 alone. That one depends on every input.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Bernstein<Number> hermite(const HermiteData<Number>& e) {
  const Number third = ratio<Number>(1, 3), sixth = ratio<Number>(1, 6), thirtieth = ratio<Number>(1, 30);
  const Number left = mul_add(third, e.v0, e.y0), right = neg_mul_add(third, e.v1, e.y1);
  const Number mean = (e.y0 + e.y1) * ratio<Number>(1, 2);
  const Number middle = mul_add(ratio<Number>(1, 40), e.a0 + e.a1, mul_add(ratio<Number>(1, 5), e.v0 - e.v1, mean));
  return {e.y0,   mul_add(sixth, e.v0, e.y0),      mul_add(thirtieth, e.a0, left),
          middle, mul_add(thirtieth, e.a1, right), neg_mul_add(sixth, e.v1, e.y1),
          e.y1};
}

template <class Number>
struct Interval {
  Number low, high;

  /// Keeps a NaN of its own, so that no comparison then proves anything.
  void include(const Number& y) { low = lesser(y, low), high = greater(y, high); }
};

/// Range of a function over a step, but for its values at the ends, by the inner coefficients of its interpolant and
/// the uncertainty of the middle one (eqs. 12 and 13). NaN if any input is: the middle coefficient stands second in
/// `lesser` and `greater`, which keep that one's NaN.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Interval<Number> enclosure(const Bernstein<Number>& c, const Number& error) {
  return {lesser(lesser(lesser(c[1], c[2]), lesser(c[4], c[5])), c[3] - error),
          greater(greater(greater(c[1], c[2]), greater(c[4], c[5])), c[3] + error)};
}

/// Range of its derivative by the part of the step, but for the values at the ends: the derivative of the interpolant
/// is off by at most M step^6 5^(1/2)/30000 (Birkhoff & Priver 1967), 1.0734 times `error`.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Interval<Number> slope_enclosure(const Bernstein<Number>& c,
                                                                          const Number& error) {
  const Number d1 = c[2] - c[1], d2 = c[3] - c[2], d3 = c[4] - c[3], d4 = c[5] - c[4];
  const Number six(6.0), off = error * Number(1.0734);
  return {mul_sub(six, lesser(lesser(d1, d4), lesser(d2, d3)), off),
          mul_add(six, greater(greater(d1, d4), greater(d2, d3)), off)};
}

/// The part of a step at which the control polygon of a polynomial that begins at >= 0 first falls below 0: a guess of
/// its first root. Meaningless if none of the coefficients is negative.
template <class Number, std::size_t size>
[[nodiscard, gnu::always_inline]] inline Number polygon_root(const std::array<Number, size>& c,
                                                             std::size_t degree = size - 1) {
  const auto at = [degree](std::size_t k) {
    return ratio<Number>(static_cast<double>(k), static_cast<double>(degree));
  };
  Number before = c[degree - 1], beyond = c[degree], u = at(degree - 1);
  for (std::size_t k = degree - 1; k-- > 0;) {
    const auto crosses = c[k + 1] < Number(0.0);
    before = select(crosses, c[k], before), beyond = select(crosses, c[k + 1], beyond), u = select(crosses, at(k), u);
  }
  return mul_add(at(1), before / (before - beyond), u);
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
template <class Number, std::size_t size>
[[nodiscard]] std::array<Number, size> split_off(std::array<Number, size>& c, const Number& u) {
  std::array<Number, size> before;
  for (std::size_t n = c.size(); n-- > 0;) {
    before[c.size() - 1 - n] = c[0];
    for (std::size_t i = 0; i < n; ++i) c[i] += u * (c[i + 1] - c[i]);
  }
  return before;
}

/// The value at u.
template <class Number, std::size_t size>
[[nodiscard]] Number value_at(std::array<Number, size> c, const Number& u) {
  return split_off(c, u).back();
}

/// The polynomial sum of p[k] u^k in the Bernstein basis: b_i is the sum of binomial(i, k)/binomial(degree, k) p[k].
template <class Number, std::size_t size>
[[nodiscard]] std::array<Number, size> from_powers(std::array<Number, size> p) {
  double binomial = 1;
  for (std::size_t k = 0; k < size; ++k) {
    p[k] = p[k] / binomial;
    binomial *= static_cast<double>(size - 1 - k) / static_cast<double>(k + 1);
  }
  for (std::size_t from = size - 1; from > 0; --from)
    for (std::size_t i = from; i < size; ++i) p[i] += p[i - 1];
  return p;
}

/// The coefficients of a polynomial by powers of u, to rounding of the largest.
template <class Number, std::size_t size>
[[nodiscard]] std::array<Number, size> to_powers(std::array<Number, size> c) {
  for (std::size_t from = 1; from < size; ++from)
    for (std::size_t i = size - 1; i >= from; --i) c[i] -= c[i - 1];
  double binomial = 1;
  for (std::size_t k = 0; k < size; ++k) {
    c[k] *= binomial;
    binomial *= static_cast<double>(size - 1 - k) / static_cast<double>(k + 1);
  }
  return c;
}

/// The same polynomial as one of a higher degree.
template <std::size_t degree, class Number, std::size_t size>
[[nodiscard]] Bernstein<Number, degree> raised_to(const std::array<Number, size>& c) {
  static_assert(degree + 1 >= size);
  if constexpr (degree + 1 == size) {
    return c;
  } else {
    std::array<Number, size + 1> higher;
    for (std::size_t i = 0; i <= size; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(size);
      higher[i] = i == 0 ? c[0] : i == size ? c[size - 1] : Number(share * c[i - 1] + (1 - share) * c[i]);
    }
    return raised_to<degree>(higher);
  }
}

/// The uncertainty of the middle coefficient if step^6 |y^(6)| <= bound over the step (eq. 13).
template <class Number>
[[nodiscard]] Number hermite_error(const Number& bound) {
  return bound / 14400;
}

/// The middle Bernstein function of degree 6 at u.
template <class Number>
[[nodiscard]] Number middle_function(const Number& u) {
  const Number w = u * (Number(1) - u);
  return Number(20) * w * w * w;
}

/// The first u in (0, 1], to rounding, at which a polynomial that begins at >= 0 becomes negative; roots at 0 don't
/// count.
template <class Number, std::size_t highest = 6>
class FirstRoot {
  using Coefficients = Bernstein<Number, highest>;

 public:
  [[nodiscard]] static std::optional<Number> of(const Coefficients& c) { return search({c, highest}, 0); }

 private:
  struct Piece {
    Coefficients c;
    std::size_t degree;

    void divide_by_u() {
      for (std::size_t i = 0; i < degree; ++i)
        c[i] = c[i + 1] * static_cast<double>(degree) / static_cast<double>(i + 1);
      --degree;
    }
    /// Coefficients of (1 + t)^degree p(t/(1 + t)) by powers of t, which has p's roots and costs less to evaluate.
    [[nodiscard]] Coefficients by_powers() const {
      Coefficients q = c;
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
    const Number guess = polygon_root(p.c, p.degree);
    const bool from_right = abs(p.c[p.degree]) < abs(p.c[0]);
    if (from_right) std::reverse(p.c.begin(), p.c.begin() + static_cast<std::ptrdiff_t>(p.degree) + 1);
    const Coefficients q = p.by_powers();
    const Number close =
        sqrt(epsilon<Number>()) / 8;  // the next iterate is exact to rounding: convergence is quadratic
    const bool falls = q[0] > 0;
    const Number turned = from_right ? Number(1 - guess) : guess;
    Number low = 0, high = std::numeric_limits<Number>::infinity(), t = turned / (1 - turned);
    if (!(t > 0 && t < high)) t = Number(0.5);
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
