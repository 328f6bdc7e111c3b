#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/ellipse.hpp"

namespace clatter {

/// Where a map that has the derivative D, and moves a state by `gap`, has its fixed point: (I - D)^-1 gap from there.
[[nodiscard]] inline Change newton_step(const Map<double>& D, const Change& gap) {
  const double determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
  return {((1 - D[3]) * gap.x + D[1] * gap.v) / determinant, (D[2] * gap.x + (1 - D[0]) * gap.v) / determinant};
}

/// The larger modulus of a map's two multipliers.
[[nodiscard]] inline double spectral_radius(const Map<double>& D) {
  const double half = (D[0] + D[3]) / 2, product = D[0] * D[3] - D[1] * D[2], square = half * half - product;
  return square < 0 ? std::sqrt(product) : std::abs(half) + std::sqrt(square);
}

/// A norm in which a map shrinks changes by little more than its larger multiplier does, by the set of all changes of
/// size 1: the ellipse with the two eigenvectors as conjugate radii, of a complex pair with real and imaginary part.
/// Where that is much thinner than need be, the two being nearly the same, the ellipse is along the first one and
/// across it, so narrow that what a change across adds along it takes no more than half of what the map takes away.
class ContractionNorm {
 public:
  explicit ContractionNorm(const Map<double>& D) {
    const double half = (D[0] + D[3]) / 2, product = D[0] * D[3] - D[1] * D[2], square = half * half - product;
    const double root = std::sqrt(std::abs(square)), first = square > 0 ? half + std::copysign(root, half) : half;
    const double second = square > 0 && first != 0 ? product / first : half;
    const Change one = square > 0 ? eigenvector(D, first) : turning(D, half, root).first;
    const Change other = square > 0 ? eigenvector(D, second) : turning(D, half, root).second;
    const double length = std::hypot(one.x, one.v), x = one.x / length, v = one.v / length;
    const double coupling = std::abs(x * (D[1] * x - D[0] * v) + v * (D[3] * x - D[2] * v));  // of (-v, x) onto (x, v)
    const double narrow = std::min(1.0, (1 - spectral_radius(D)) / (2 * coupling));
    const double area = std::abs(one.x * other.v - one.v * other.x);
    if (area >= narrow / 4) {
      unit_ = {one.x * one.x + other.x * other.x, one.x * one.v + other.x * other.v, one.v * one.v + other.v * other.v};
    } else {
      const double square_narrow = narrow * narrow;
      unit_ = {x * x + square_narrow * v * v, x * v * (1 - square_narrow), v * v + square_narrow * x * x};
    }
  }

  [[nodiscard]] double of(const Change& e) const {
    const double size = e.size();  // divided out: the squares of small changes vanish
    if (!(size > 0)) return size;
    const double x = e.x / size, v = e.v / size;
    return size * std::sqrt((unit_.vv_ * x * x - 2 * unit_.xv_ * x * v + unit_.xx_ * v * v) / unit_.area());
  }
  /// Of the largest change in an ellipse.
  [[nodiscard]] double of(const Ellipse& e) const {
    const double half = (unit_.vv_ * e.xx_ - 2 * unit_.xv_ * e.xv_ + unit_.xx_ * e.vv_) / (2 * unit_.area());
    const double product = std::max(0.0, e.area() / unit_.area());
    return std::sqrt(half + std::sqrt(std::max(0.0, half * half - product)));
  }
  /// All changes up to a size.
  [[nodiscard]] Ellipse disc(double radius) const {
    const double square = radius * radius;
    return {square * unit_.xx_, square * unit_.xv_, square * unit_.vv_};
  }

 private:
  /// Of length 1.
  [[nodiscard]] static Change eigenvector(const Map<double>& D, double multiplier) {
    const Change a{D[1], multiplier - D[0]}, b{multiplier - D[3], D[2]};  // each 0 where it isn't one
    const Change& e = a.size() > b.size() ? a : b;
    const double length = std::hypot(e.x, e.v);
    return length > 0 ? Change{e.x / length, e.v / length} : Change{1, 0};
  }
  /// Real and imaginary part of the eigenvector to half + i root, of length 1 together.
  [[nodiscard]] static std::pair<Change, Change> turning(const Map<double>& D, double half, double root) {
    const bool first = std::abs(D[1]) > std::abs(D[2]);
    const Change real = first ? Change{D[1], half - D[0]} : Change{half - D[3], D[2]};
    const Change imaginary = first ? Change{0, root} : Change{root, 0};
    const double length = std::hypot(real.x, real.v, root);
    if (!(length > 0)) return {{1, 0}, {0, 1}};
    return {{real.x / length, real.v / length}, {imaginary.x / length, imaginary.v / length}};
  }

  Ellipse unit_;
};

}  // namespace clatter
