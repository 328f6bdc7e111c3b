#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/ellipse.hpp"

namespace clatter::steady {

/// The step to the fixed point of a map that moves a state by `gap` and has the derivative D: (I - D)^-1 gap.
[[nodiscard]] inline motion::Perturbation newton_step(const motion::Jacobian<double>& D,
                                                      const motion::Perturbation& gap) {
  const double determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
  return {((1 - D[3]) * gap.x + D[1] * gap.v) / determinant, (D[2] * gap.x + (1 - D[0]) * gap.v) / determinant};
}

/// The larger modulus of a map's two multipliers.
[[nodiscard]] inline double spectral_radius(const motion::Jacobian<double>& D) {
  const double half = (D[0] + D[3]) / 2, product = D[0] * D[3] - D[1] * D[2], square = half * half - product;
  return square < 0 ? std::sqrt(product) : std::abs(half) + std::sqrt(square);
}

/// A norm in which a map shrinks changes nearly as fast as its larger multiplier allows. Its unit ellipse has the two
/// eigenvectors as conjugate radii, for a complex pair their real and imaginary part. If they nearly coincide, that
/// ellipse would be thinner than necessary: its axes are then along and across the first eigenvector, so narrow across
/// that the coupling undoes at most half of the contraction.
class ContractionNorm {
 public:
  explicit ContractionNorm(const motion::Jacobian<double>& D) {
    const double half = (D[0] + D[3]) / 2, product = D[0] * D[3] - D[1] * D[2], square = half * half - product;
    const double root = std::sqrt(std::abs(square)), first = square > 0 ? half + std::copysign(root, half) : half;
    const double second = square > 0 && first != 0 ? product / first : half;
    const motion::Perturbation one = square > 0 ? eigenvector(D, first) : turning(D, half, root).first;
    const motion::Perturbation other = square > 0 ? eigenvector(D, second) : turning(D, half, root).second;
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

  [[nodiscard]] double of(const motion::Perturbation& e) const {
    const double size = e.size();  // divided out: the squares of small changes vanish
    if (!(size > 0)) return size;
    const double x = e.x / size, v = e.v / size;
    return size * std::sqrt((unit_.vv() * x * x - 2 * unit_.xv() * x * v + unit_.xx() * v * v) / unit_.determinant());
  }
  /// The norm of the largest change in an ellipse.
  [[nodiscard]] double of(const motion::Ellipse& e) const {
    const double half =
        (unit_.vv() * e.xx() - 2 * unit_.xv() * e.xv() + unit_.xx() * e.vv()) / (2 * unit_.determinant());
    const double product = std::max(0.0, e.determinant() / unit_.determinant());
    return std::sqrt(half + std::sqrt(std::max(0.0, half * half - product)));
  }
  /// All changes of norm up to `radius`.
  [[nodiscard]] motion::Ellipse disc(double radius) const {
    const double square = radius * radius;
    return {square * unit_.xx(), square * unit_.xv(), square * unit_.vv()};
  }

 private:
  /// An eigenvector of length 1.
  [[nodiscard]] static motion::Perturbation eigenvector(const motion::Jacobian<double>& D, double multiplier) {
    const motion::Perturbation a{D[1], multiplier - D[0]},
        b{multiplier - D[3], D[2]};  // either may be 0, and is then no eigenvector
    const motion::Perturbation& e = a.size() > b.size() ? a : b;
    const double length = std::hypot(e.x, e.v);
    return length > 0 ? motion::Perturbation{e.x / length, e.v / length} : motion::Perturbation{1, 0};
  }
  /// Real and imaginary part of the eigenvector to half + i root, of length 1 together.
  [[nodiscard]] static std::pair<motion::Perturbation, motion::Perturbation> turning(const motion::Jacobian<double>& D,
                                                                                     double half, double root) {
    const bool first = std::abs(D[1]) > std::abs(D[2]);
    const motion::Perturbation real =
        first ? motion::Perturbation{D[1], half - D[0]} : motion::Perturbation{half - D[3], D[2]};
    const motion::Perturbation imaginary = first ? motion::Perturbation{0, root} : motion::Perturbation{root, 0};
    const double length = std::hypot(real.x, real.v, root);
    if (!(length > 0)) return {{1, 0}, {0, 1}};
    return {{real.x / length, real.v / length}, {imaginary.x / length, imaginary.v / length}};
  }

  motion::Ellipse unit_;
};

}  // namespace clatter::steady
