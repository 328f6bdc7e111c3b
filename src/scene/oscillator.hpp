#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/force_shape.hpp"

namespace clatter {
inline namespace scene {

/// x'' + 2 h x' + k x = f sin(nu tau + phase) + load (eq. 3): with k = 1 in units of the natural frequency and the
/// spring. A force of another shape is f s(nu tau + phase).
template <class Number>
struct BasicOscillator {
  Number damping{0.0};              ///< h, damping ratio, >= 0
  Number forcing{0.0};              ///< f, force amplitude over stiffness, any finite
  Number frequency{1.0};            ///< nu, excitation over natural frequency, > 0
  Number load{0.0};                 ///< constant force over stiffness, any finite
  Number stiffness{1.0};            ///< k, any finite: 0 without a spring, negative for one that pushes away
  BasicForceShape<Number> shape{};  ///< of the force
  bool paces_stops = false;         ///< stops move by themselves with its frequency, under a force or without one

  friend bool operator==(const BasicOscillator&, const BasicOscillator&) = default;
};
using Oscillator = BasicOscillator<double>;

/// Whether a force acts, or stops move by themselves: then a motion is looked at once in each period of that.
template <class Number = double>
[[nodiscard]] constexpr bool is_driven(const BasicOscillator<Number>& oscillator) {
  return oscillator.forcing != 0 || oscillator.paces_stops;
}

/// The natural frequency of the spring, |k|^(1/2); of an unstable one (k < 0) the rate at which motion departs.
template <class Number = double>
[[nodiscard]] Number natural_frequency(const BasicOscillator<Number>& oscillator) {
  using std::abs, std::sqrt;
  return sqrt(Number(abs(oscillator.stiffness)));
}

/// The rate by which velocities are divided before they are compared with displacements: 1, unless the spring and the
/// force, of which the faster one counts, are both much slower, or one is much faster.
[[nodiscard]] inline double pace_of(const Oscillator& oscillator) {
  constexpr double much = 16;
  const double force = is_driven(oscillator) ? oscillator.frequency : 0;
  const double pace = std::max(natural_frequency(oscillator), force);
  return pace > much || (pace > 0 && pace * much < 1) ? pace : 1;
}

/// The displacement at which the spring balances the load; 0 without a spring.
[[nodiscard]] constexpr double equilibrium_of(const Oscillator& oscillator) {
  return oscillator.stiffness == 0.0 ? 0.0 : oscillator.load / oscillator.stiffness;
}

/// The constant part of the force on a mass at a displacement.
[[nodiscard]] constexpr double constant_force(const Oscillator& oscillator, double x) {
  return oscillator.load - oscillator.stiffness * x;
}

/// The same oscillator with its time in units of its natural frequency, so that its stiffness is 1, or -1; not for k =
/// 0. Displacements stay as they are, velocities are divided by that frequency.
[[nodiscard]] inline Oscillator with_unit_spring(const Oscillator& oscillator) {
  const double k = std::abs(oscillator.stiffness), rate = natural_frequency(oscillator);
  return {oscillator.damping / rate,
          oscillator.forcing / k,
          oscillator.frequency / rate,
          oscillator.load / k,
          std::copysign(1.0, oscillator.stiffness),
          oscillator.shape,
          oscillator.paces_stops};
}

/// The frequency of the periods in which a run is counted: nu if something is driven by it, else that of the spring, 1
/// if it has none.
template <class Number = double>
[[nodiscard]] Number counting_frequency(const BasicOscillator<Number>& oscillator) {
  if (is_driven(oscillator)) return oscillator.frequency;
  return oscillator.stiffness > 0 ? natural_frequency(oscillator) : Number(1);
}

/// Forcing period in tau; without forcing that of the spring, 2 pi at k = 1.
[[nodiscard]] inline double period_of(const Oscillator& oscillator) {
  return 2 * std::numbers::pi / counting_frequency(oscillator);
}

}  // namespace scene
}  // namespace clatter
