#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "math/number.hpp"
#include "motion/event.hpp"

namespace clatter::observables {

/// Passes on an impact's jump of the velocity times e^{-ik theta}, theta being the forcing phase since observation
/// began, for each harmonic k = 0 ... highest (eq. 38): add(k, real part, imaginary part).
template <class Number, class Add>
void over_harmonics(const Number& jump, const SineCosine<Number>& theta, std::size_t highest, const Add& add) {
  Number real = jump, imaginary = Number(0);
  for (std::size_t k = 0; k <= highest; ++k) {
    add(k, real, imaginary);
    const Number turned = mul_add(real, theta.cosine, imaginary * theta.sine);
    imaginary = mul_sub(imaginary, theta.cosine, real * theta.sine);
    real = turned;
  }
}

/// Sums them over impacts, whose times count from an instant at which that phase is 0.
class VelocityJumps {
 public:
  VelocityJumps(double frequency, std::size_t highest) : frequency_(frequency), sums_(highest + 1) {}

  void impact(const motion::Event& impact) {
    const double angle = frequency_ * impact.time;
    over_harmonics<double>(
        impact.after - impact.before, {std::sin(angle), std::cos(angle)}, sums_.size() - 1,
        [this](std::size_t k, double real, double imaginary) { sums_[k] += std::complex(real, imaginary); });
  }
  [[nodiscard]] const std::vector<std::complex<double>>& sums() const { return sums_; }  ///< [harmonic]

 private:
  double frequency_;
  std::vector<std::complex<double>> sums_;
};

}  // namespace clatter::observables
