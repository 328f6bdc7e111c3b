#pragma once

#include <array>
#include <vector>

#include "branches/equations.hpp"
#include "observables/extrema.hpp"

namespace clatter::branches {

/// Multipliers of an orbit over its whole period, and whether both lie within the unit circle.
struct Multipliers {
  std::array<double, 2> re, im;  ///< the one of larger modulus first
  bool stable;
};
[[nodiscard]] Multipliers multipliers(const Scene& scene, const Orbit& orbit);

/// The state when the forcing phase is 0.
[[nodiscard]] PhasePoint state_at_phase_zero(const Scene& scene, const Orbit& orbit);

/// Least and greatest displacement and velocity.
[[nodiscard]] observables::Extrema extrema(const Scene& scene, const Orbit& orbit);

/// Quantities that have maxima along a branch, with their derivatives along a tangent of its equations.
struct Measure {
  double value = 0.0, slope = 0.0;
};
/// Speed of the fastest impact.
[[nodiscard]] Measure impact_speed(const OrbitEquations& equations, const Vector& point, const Vector& tangent);
/// Energy lost in impacts per tau, per unit mass.
[[nodiscard]] Measure impact_power(const OrbitEquations& equations, const Vector& point, const Vector& tangent);
/// Amplitude of the harmonic of x at the forcing frequency (eq. 28).
[[nodiscard]] Measure harmonic(const OrbitEquations& equations, const Vector& point, const Vector& tangent);

}  // namespace clatter::branches
