#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "ball.hpp"

namespace verify {

/// Two numbers.
template <class Number>
struct BasicVector {
  Number x, y;

  friend BasicVector operator+(const BasicVector& p, const BasicVector& q) { return {p.x + q.x, p.y + q.y}; }
  friend BasicVector operator-(const BasicVector& p, const BasicVector& q) { return {p.x - q.x, p.y - q.y}; }
  friend BasicVector operator-(const BasicVector& p) { return {-p.x, -p.y}; }
  /// What a function makes of each number.
  template <class Function>
  [[nodiscard]] BasicVector each(const Function& function) const {
    return {function(x), function(y)};
  }
  /// Whether a predicate is true of each number and that of another vector in its place.
  template <class Predicate>
  [[nodiscard]] bool all(const BasicVector& other, const Predicate& predicate) const {
    return predicate(x, other.x) && predicate(y, other.y);
  }
  [[nodiscard]] BasicVector middle() const { return {x.middle(), y.middle()}; }
};
using Vector = BasicVector<Ball>;

/// A 2 x 2 matrix, by rows.
template <class Number>
struct BasicMatrix {
  Number a, b, c, d;

  [[nodiscard]] static BasicMatrix zero() { return {Number(0), Number(0), Number(0), Number(0)}; }
  [[nodiscard]] static BasicMatrix identity() { return {Number(1), Number(0), Number(0), Number(1)}; }
  friend BasicMatrix operator*(const BasicMatrix& p, const BasicMatrix& q) {
    return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c, p.c * q.b + p.d * q.d};
  }
  friend BasicVector<Number> operator*(const BasicMatrix& m, const BasicVector<Number>& p) {
    return {m.a * p.x + m.b * p.y, m.c * p.x + m.d * p.y};
  }
  friend BasicMatrix operator-(const BasicMatrix& p) { return {-p.a, -p.b, -p.c, -p.d}; }
  [[nodiscard]] BasicMatrix less_identity() const { return {a - Number(1), b, c, d - Number(1)}; }
  [[nodiscard]] Number determinant() const { return a * d - b * c; }
  [[nodiscard]] BasicMatrix inverse() const {
    const Number e = determinant();
    return {d / e, -b / e, -c / e, a / e};
  }
  [[nodiscard]] BasicMatrix middle() const { return {a.middle(), b.middle(), c.middle(), d.middle()}; }
};
using Matrix = BasicMatrix<Ball>;

/// Four numbers: x, x', z, z' or what stands in their place.
struct Four {
  std::array<Ball, 4> at;

  [[nodiscard]] static Four zero() { return {{Ball(0), Ball(0), Ball(0), Ball(0)}}; }
  [[nodiscard]] const Ball& operator[](std::size_t i) const { return at[i]; }
  [[nodiscard]] Ball& operator[](std::size_t i) { return at[i]; }
  friend Four operator+(Four p, const Four& q) {
    for (std::size_t i = 0; i < 4; ++i) p[i] = p[i] + q[i];
    return p;
  }
  friend Four operator-(const Four& p) {
    return p.each([](const Ball& x) { return -x; });
  }
  friend Four operator-(const Four& p, const Four& q) { return p + (-q); }
  template <class Function>
  [[nodiscard]] Four each(const Function& function) const {
    return {{function(at[0]), function(at[1]), function(at[2]), function(at[3])}};
  }
  template <class Predicate>
  [[nodiscard]] bool all(const Four& other, const Predicate& predicate) const {
    for (std::size_t i = 0; i < 4; ++i)
      if (!predicate(at[i], other[i])) return false;
    return true;
  }
  [[nodiscard]] Four middle() const {
    return each([](const Ball& x) { return x.middle(); });
  }
};

/// A 4 x 4 matrix, by rows. Numbers that are 0 exactly take no time: without a loose mass half of them are.
struct FourByFour {
  std::array<Four, 4> rows;

  [[nodiscard]] static FourByFour zero() { return {{Four::zero(), Four::zero(), Four::zero(), Four::zero()}}; }
  [[nodiscard]] static FourByFour identity() {
    FourByFour one = zero();
    for (std::size_t i = 0; i < 4; ++i) one[i][i] = Ball(1);
    return one;
  }
  [[nodiscard]] const Four& operator[](std::size_t i) const { return rows[i]; }
  [[nodiscard]] Four& operator[](std::size_t i) { return rows[i]; }
  friend Four operator*(const FourByFour& m, const Four& p) {
    Four image = Four::zero();
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        if (!m[i][k].is_zero()) image[i] = image[i] + m[i][k] * p[k];
    return image;
  }
  friend FourByFour operator*(const FourByFour& m, const FourByFour& n) {
    FourByFour product = zero();
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t j = 0; j < 4 && !m[i][k].is_zero(); ++j)
          if (!n[k][j].is_zero()) product[i][j] = product[i][j] + m[i][k] * n[k][j];
    return product;
  }
  friend FourByFour operator-(const FourByFour& m) { return {{-m[0], -m[1], -m[2], -m[3]}}; }
  friend FourByFour operator+(FourByFour m, const FourByFour& n) {
    for (std::size_t i = 0; i < 4; ++i) m[i] = m[i] + n[i];
    return m;
  }
  [[nodiscard]] FourByFour less_identity() const {
    FourByFour m = *this;
    for (std::size_t i = 0; i < 4; ++i) m[i][i] = m[i][i] - Ball(1);
    return m;
  }
  /// By elimination with pivots; not finite if balls are too wide to tell.
  [[nodiscard]] FourByFour inverse() const;
  [[nodiscard]] FourByFour middle() const {
    return {{rows[0].middle(), rows[1].middle(), rows[2].middle(), rows[3].middle()}};
  }
};

/// The part of the main mass.
[[nodiscard]] inline Vector of_main(const Four& y) { return {y[0], y[1]}; }
[[nodiscard]] inline Matrix of_main(const FourByFour& m) { return {m[0][0], m[0][1], m[1][0], m[1][1]}; }

/// A frame whose first axis is the longest side of the image of a box, and so on; `uncertain` is what a derivative
/// that is carried along adds to the box. Any frame is right, a good one narrow.
[[nodiscard]] FourByFour frame_along(const FourByFour& image, const Four& box, const FourByFour& uncertain);

}  // namespace verify
