#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include "observables/energy/quadrature.hpp"

namespace clatter::observables {

/// A motion over a panel of time in which nothing of it turns by more than 4 radians, by its values at the 20 points of
/// Gauss's rule: for integrals with waves of any frequency, to the rounding of the motion itself.
///
/// Slow waves are integrated by the rule. Of faster ones the motion is a sum of Legendre polynomials, whose integrals
/// are spherical Bessel functions: int P_n(t) e^{-i omega t} dt = 2 (-i)^n j_n(omega), -1 <= t <= 1.
class Panel {
 public:
  using Complex = std::complex<double>;

  /// Of the motion `at(s)`, |s - middle| <= half.
  template <class Motion>
  Panel(double middle, double half, const Motion& at) : half_(half) {
    for (std::size_t i = 0; i < pairs; ++i) {
      const auto [t, weight] = gauss_of_twenty[i];
      const double before = at(middle - half * t), after = at(middle + half * t);
      even_[i] = weight * (after + before), odd_[i] = weight * (after - before);
    }
  }

  /// Integral of the motion times e^{-iw (s - middle)} over the panel, w >= 0.
  [[nodiscard]] Complex integral(double w) {
    const double omega = w * half_;
    return half_ * (omega < slow ? by_points(omega) : by_polynomials(omega));
  }

 private:
  static constexpr std::size_t pairs = std::tuple_size_v<decltype(gauss_of_twenty)>;
  static constexpr double slow = 8;  ///< the rule is exact to rounding up to 12 less the 2 radians of the motion

  [[nodiscard]] Complex by_points(double omega) const {
    double real = 0, imaginary = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
      const double angle = omega * gauss_of_twenty[i].abscissa;
      real += even_[i] * std::cos(angle), imaginary -= odd_[i] * std::sin(angle);
    }
    return {real, imaginary};
  }
  /// j_n from j_{n-1} and j_{n-2}. Beyond n = omega that loses digits, fewer than the polynomials of the motion fall.
  [[nodiscard]] Complex by_polynomials(double omega) {
    if (!has_moments_) make_moments();
    double before = std::cos(omega) / omega, j = std::sin(omega) / omega;
    std::array<double, 4> sums{};  // of the powers of -i
    for (std::size_t n = 0; n < 2 * pairs; ++n) {
      const double degree = 2 * static_cast<double>(n) + 1;
      sums[n % 4] += degree * moments_[n] * j;
      const double next = degree / omega * j - before;
      before = j, j = next;
    }
    return {sums[0] - sums[2], sums[3] - sums[1]};
  }
  /// Integrals of the motion times P_n(t).
  void make_moments() {
    for (std::size_t i = 0; i < pairs; ++i) {
      const double t = gauss_of_twenty[i].abscissa;
      double before = 0, p = 1;
      for (std::size_t n = 0; n < 2 * pairs; ++n) {
        moments_[n] += (n % 2 == 0 ? even_[i] : odd_[i]) * p;
        const auto order = static_cast<double>(n);
        const double next = ((2 * order + 1) * t * p - order * before) / (order + 1);
        before = p, p = next;
      }
    }
    has_moments_ = true;
  }

  double half_;
  std::array<double, pairs> even_, odd_;  ///< weights times the sums and differences of values at +t and -t
  std::array<double, 2 * pairs> moments_{};
  bool has_moments_ = false;
};

}  // namespace clatter::observables
