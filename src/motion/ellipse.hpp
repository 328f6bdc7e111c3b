#pragma once

#include <algorithm>
#include <cmath>

#include "math/number.hpp"
#include "motion/perturbation.hpp"

namespace clatter::motion {

/// A set of changes around 0: {e : e' E^-1 e <= 1}, given by the symmetric matrix E.
class Ellipse {
 public:
  Ellipse() = default;
  Ellipse(double xx, double xv, double vv) : xx_(xx), xv_(xv), vv_(vv) {}
  [[nodiscard]] static Ellipse disc(double radius) { return {radius * radius, 0, radius * radius}; }

  [[nodiscard]] double xx() const { return xx_; }  ///< entries of E
  [[nodiscard]] double xv() const { return xv_; }
  [[nodiscard]] double vv() const { return vv_; }
  [[nodiscard]] double determinant() const { return xx_ * vv_ - xv_ * xv_; }  ///< of E
  [[nodiscard]] double x() const { return std::sqrt(xx_); }  ///< the largest change of the displacement
  [[nodiscard]] double v() const { return std::sqrt(vv_); }  ///< and of the velocity
  /// The largest x + q v of a change.
  [[nodiscard]] double along(double q) const { return std::sqrt(std::max(0.0, xx_ + q * (2 * xv_ + q * vv_))); }
  /// The larger semi-axis.
  [[nodiscard]] double size() const { return std::sqrt((xx_ + vv_) / 2 + norm((xx_ - vv_) / 2, xv_)); }

  /// Its image: D E D'.
  [[nodiscard]] Ellipse mapped(const Jacobian<double>& D) const {
    const double ax = D[0] * xx_ + D[1] * xv_, av = D[0] * xv_ + D[1] * vv_, bx = D[2] * xx_ + D[3] * xv_,
                 bv = D[2] * xv_ + D[3] * vv_;
    return {ax * D[0] + av * D[1], ax * D[2] + av * D[3], bx * D[2] + bv * D[3]};
  }
  /// Becomes an ellipse that holds every sum of one of its changes and one of another's: of all those, the one of least
  /// trace.
  void add(const Ellipse& other) {
    const double mine = std::sqrt(xx_ + vv_), its = std::sqrt(other.xx_ + other.vv_);
    if (!(mine > 0)) *this = other;
    if (!(mine > 0 && its > 0)) return;
    const double p = 1 + its / mine, q = 1 + mine / its;
    xx_ = p * xx_ + q * other.xx_, xv_ = p * xv_ + q * other.xv_, vv_ = p * vv_ + q * other.vv_;
  }

 private:
  double xx_ = 0, xv_ = 0, vv_ = 0;
};

}  // namespace clatter::motion
