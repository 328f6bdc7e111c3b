#pragma once

#include <numbers>

namespace clatter {
inline namespace model {

/// x'' + 2 h x' + x = f sin(nu tau + phase) + load, in units of the natural frequency and the spring (eq. 3).
struct Oscillator {
  double damping = 0.0;    ///< h, damping ratio, >= 0
  double forcing = 0.0;    ///< f, force amplitude over stiffness, any finite
  double frequency = 1.0;  ///< nu, excitation over natural frequency, > 0
  double load = 0.0;       ///< constant force over stiffness, any finite
};

/// The frequency of the periods in which a run is counted: nu under forcing, else 1.
[[nodiscard]] constexpr double counting_frequency(const Oscillator& oscillator) {
  return oscillator.forcing == 0.0 ? 1.0 : oscillator.frequency;
}

/// Forcing period in tau; without forcing 2 pi.
[[nodiscard]] constexpr double period_of(const Oscillator& oscillator) {
  return 2 * std::numbers::pi / counting_frequency(oscillator);
}

}  // namespace model
}  // namespace clatter
