#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/perturbation.hpp"

namespace clatter::certificates {

/// How a motion stretches errors: of the state at its start, and of the rounding that each flight adds on the way. An
/// error that enters late is stretched by what is left of the motion, though what is before it may have contracted.
class Growth {
 public:
  /// A flight and the event before it, with their derivative; it adds rounding of so many units.
  void pass(const motion::Jacobian<double>& step, double rounding) {
    const auto& [a, b, c, d] = step;
    const motion::Jacobian<double> m = derivative_;
    derivative_ = {a * m[0] + b * m[2], a * m[1] + b * m[3], c * m[0] + d * m[2], c * m[1] + d * m[3]};
    const auto [xx, xv, vv] = spread_;
    spread_ = {a * a * xx + 2 * a * b * xv + b * b * vv, a * c * xx + (a * d + b * c) * xv + b * d * vv,
               c * c * xx + 2 * c * d * xv + d * d * vv};
    before_ = {std::sqrt(std::max(0.0, spread_[0])), std::sqrt(std::max(0.0, spread_[2]))};
    spread_[0] += rounding * rounding, spread_[2] += rounding * rounding;
  }

  [[nodiscard]] const motion::Jacobian<double>& derivative() const { return derivative_; }  ///< from the start
  /// The rounding of earlier flights as it has grown, in x and in v: the root of the sum of squares.
  [[nodiscard]] const std::array<double, 2>& rounding() const { return before_; }

 private:
  motion::Jacobian<double> derivative_{1, 0, 0, 1};
  std::array<double, 3> spread_{};  ///< covariance: xx, xv, vv
  std::array<double, 2> before_{};
};

}  // namespace clatter::certificates
