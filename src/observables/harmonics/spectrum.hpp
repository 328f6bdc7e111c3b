#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace clatter::observables {

/// Amplitude and phase of the constant part and the harmonics, shape [harmonic]: a_0 signed, its phase NaN.
struct Spectrum {
  std::vector<double> amplitude, phase;

  /// From the complex coefficients X_k, shape [harmonic]: x = X_0 + 2 Re sum X_k e^{ik Omega tau}.
  static Spectrum of(const std::vector<std::complex<double>>& coefficients) {
    Spectrum spectrum;
    for (const auto& c : coefficients) {
      const bool constant = spectrum.amplitude.empty();
      spectrum.amplitude.push_back(constant ? c.real() : 2 * std::abs(c));
      spectrum.phase.push_back(constant ? std::numeric_limits<double>::quiet_NaN() : std::arg(c));
    }
    return spectrum;
  }
};

}  // namespace clatter::observables
