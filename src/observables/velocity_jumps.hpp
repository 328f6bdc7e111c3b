#pragma once

#include <cstddef>

#include "math/number.hpp"

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

}  // namespace clatter::observables
