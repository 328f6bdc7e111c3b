#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/tangent.hpp"

namespace clatter {

/// A small change of a state.
struct Change {
  double x = 0.0, v = 0.0;

  [[nodiscard]] double size() const { return std::max(std::abs(x), std::abs(v)); }
};

[[nodiscard]] inline Change between(const State<double>& from, const State<double>& to) {
  return {to.x - from.x, to.v - from.v};
}

[[nodiscard]] inline Change operator*(const Map<double>& map, const Change& c) {
  return {map[0] * c.x + map[1] * c.v, map[2] * c.x + map[3] * c.v};
}

/// A set of changes around none: {e : e' E^-1 e <= 1}, by the symmetric matrix E.
class Ellipse {
 public:
  Ellipse() = default;
  Ellipse(double xx, double xv, double vv) : xx_(xx), xv_(xv), vv_(vv) {}
  [[nodiscard]] static Ellipse disc(double radius) { return {radius * radius, 0, radius * radius}; }

  [[nodiscard]] double x() const { return std::sqrt(xx_); }  ///< the largest change of the displacement
  [[nodiscard]] double v() const { return std::sqrt(vv_); }  ///< and of the velocity
  /// The larger semi-axis.
  [[nodiscard]] double size() const { return std::sqrt((xx_ + vv_) / 2 + norm((xx_ - vv_) / 2, xv_)); }

  /// Its image: D E D'.
  [[nodiscard]] Ellipse mapped(const Map<double>& D) const {
    const double ax = D[0] * xx_ + D[1] * xv_, av = D[0] * xv_ + D[1] * vv_, bx = D[2] * xx_ + D[3] * xv_,
                 bv = D[2] * xv_ + D[3] * vv_;
    return {ax * D[0] + av * D[1], ax * D[2] + av * D[3], bx * D[2] + bv * D[3]};
  }
  /// Becomes an ellipse that holds the sums of its changes and those of another: of all such ones that of least trace.
  void add(const Ellipse& other) {
    const double mine = std::sqrt(xx_ + vv_), its = std::sqrt(other.xx_ + other.vv_);
    if (!(mine > 0)) *this = other;
    if (!(mine > 0 && its > 0)) return;
    const double p = 1 + its / mine, q = 1 + mine / its;
    xx_ = p * xx_ + q * other.xx_, xv_ = p * xv_ + q * other.xv_, vv_ = p * vv_ + q * other.vv_;
  }

 private:
  friend class ContractionNorm;
  double xx_ = 0, xv_ = 0, vv_ = 0;
};

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

/// A norm in which a map D contracts, and by how much: |e|^2 = e' M e with D' M D - M = -I, so that
/// |D e|^2 <= (1 - 1/lambda) |e|^2 with M's larger eigenvalue lambda. There is one when both multipliers lie within the
/// unit circle.
class ContractionNorm {
 public:
  explicit ContractionNorm(Map<double> D) {
    for (int doubling = 0; doubling < 60; ++doubling) {  // M = sum D'^j D^j, twice as many terms each time
      const double xx = D[0] * (xx_ * D[0] + xv_ * D[2]) + D[2] * (xv_ * D[0] + vv_ * D[2]);
      const double xv = D[0] * (xx_ * D[1] + xv_ * D[3]) + D[2] * (xv_ * D[1] + vv_ * D[3]);
      const double vv = D[1] * (xx_ * D[1] + xv_ * D[3]) + D[3] * (xv_ * D[1] + vv_ * D[3]);
      xx_ += xx, xv_ += xv, vv_ += vv;
      if (!(xx + vv < most)) return;                                 // it grows without end
      if (!(xx_ >= 1 && vv_ >= 1 && xx_ * vv_ > xv_ * xv_)) return;  // M >= I: rounding has eaten it
      if (xx + vv <= std::numeric_limits<double>::epsilon() * (xx_ + vv_)) {
        const double larger = (xx_ + vv_) / 2 + norm((xx_ - vv_) / 2, xv_);
        factor_ = std::sqrt(1 - 1 / larger);
        return;
      }
      D = {D[0] * D[0] + D[1] * D[2], D[1] * (D[0] + D[3]), D[2] * (D[0] + D[3]), D[1] * D[2] + D[3] * D[3]};
    }
  }

  /// At most this share of a change is left after the map; 1 where there is no such norm.
  [[nodiscard]] double factor() const { return factor_; }
  [[nodiscard]] double of(const Change& e) const {
    const double size = e.size();  // divided out: the squares of small changes vanish
    if (!(size > 0)) return size;
    const double x = e.x / size, v = e.v / size;
    return size * std::sqrt(std::max(0.0, xx_ * x * x + 2 * xv_ * x * v + vv_ * v * v));
  }
  /// Of the largest change in an ellipse.
  [[nodiscard]] double of(const Ellipse& e) const {
    const double half = (xx_ * e.xx_ + 2 * xv_ * e.xv_ + vv_ * e.vv_) / 2,
                 area = (e.xx_ * e.vv_ - e.xv_ * e.xv_) * determinant();
    return std::sqrt(half + std::sqrt(std::max(0.0, half * half - std::max(0.0, area))));
  }
  /// All changes up to a size.
  [[nodiscard]] Ellipse disc(double radius) const {
    const double scale = radius * radius / determinant();
    return {vv_ * scale, -xv_ * scale, xx_ * scale};
  }

 private:
  [[nodiscard]] double determinant() const { return xx_ * vv_ - xv_ * xv_; }

  static constexpr double most = 1e12;
  double xx_ = 1, xv_ = 0, vv_ = 1;  ///< M
  double factor_ = 1;
};

}  // namespace clatter
