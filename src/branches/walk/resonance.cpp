#include "branches/walk/resonance.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "branches/equations/flight.hpp"

namespace clatter::branches {
namespace {

/// A displacement's amplitude, with the phase that it has beside what is shaken, and its derivative by the parameter.
struct ComplexAmplitude {
  std::complex<double> value, slope;
};

ComplexAmplitude amplitude(const FollowedScene& scene, Side pressed, Parameter parameter) {
  return with_arcs(scene, [&]<Effects E>() -> ComplexAmplitude {
    const Flights<Along, E> flights{numbers_along(scene, parameter)};
    const Along sine = sin(flights.lead()), cosine = cos(flights.lead());
    return flights.with_response(pressed, [&](const auto&, const Response<Along>& of_force) -> ComplexAmplitude {
      const Along in_phase = of_force.in_phase * cosine - of_force.quadrature * sine,
                  quadrature = of_force.in_phase * sine + of_force.quadrature * cosine;
      return {{in_phase.value, quadrature.value}, {in_phase.slope[0], quadrature.slope[0]}};
    });
  });
}

}  // namespace

bool may_resonate_between(const OrbitEquations& equations, const Vector& one, const Vector& other) {
  const Orbit& orbit = equations.shape();
  const OrbitEquations::Axis& axis = equations.axes().front();
  if (orbit.size() > 0 || has_loose_mass(equations.scene_at(one).loose)) return false;
  // from two sides of a pole within a step the tangents miss by three times the amplitude or more
  constexpr double rough = 0.5;
  const auto here = amplitude(equations.scene_at(one), orbit.pressed, axis.parameter),
             there = amplitude(equations.scene_at(other), orbit.pressed, axis.parameter);
  const double ahead = (other.back() - one.back()) * axis.unit,
               most = rough * std::max(std::abs(here.value), std::abs(there.value));
  const std::complex<double> change = there.value - here.value;
  return std::abs(change - ahead * here.slope) > most || std::abs(change - ahead * there.slope) > most;
}

}  // namespace clatter::branches
