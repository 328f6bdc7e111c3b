#include "branches/walk/resonance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "branches/equations/flight.hpp"

namespace clatter::branches {
namespace {

/// The amplitude of an order of displacement, with the phase that it has beside what is shaken, and its derivative by
/// the parameter.
struct ComplexAmplitude {
  std::complex<double> value, slope;
};
using Amplitudes = std::array<ComplexAmplitude, ForceOrders<double>::most>;

Amplitudes amplitudes(const FollowedScene& scene, Side pressed, Parameter parameter) {
  return with_arcs(scene, [&]<Effects E>() {
    const Flights<Along, E> flights{numbers_along(scene, parameter)};
    const ForceOrders<Along> response = flights.response(pressed);
    Amplitudes all;
    response.each({sin(flights.lead()), cos(flights.lead())}, [&](int j, const Along& value, const Along& slope) {
      all[static_cast<std::size_t>(j) - 1] = {{slope.value, value.value}, {slope.slope[0], value.slope[0]}};
    });
    return all;
  });
}

}  // namespace

bool may_resonate_between(const OrbitEquations& equations, const Vector& one, const Vector& other) {
  const Orbit& orbit = equations.shape();
  const OrbitEquations::Axis& axis = equations.axes().front();
  if (orbit.size() > 0 || has_loose_mass(equations.scene_at(one).loose)) return false;
  // from two sides of a pole within a step the tangents miss by three times the amplitude or more
  constexpr double rough = 0.5;
  const Amplitudes here = amplitudes(equations.scene_at(one), orbit.pressed, axis.parameter),
                   there = amplitudes(equations.scene_at(other), orbit.pressed, axis.parameter);
  const double ahead = (other.back() - one.back()) * axis.unit;
  return !std::ranges::equal(here, there, [&](const ComplexAmplitude& from, const ComplexAmplitude& to) {
    const double most = rough * std::max(std::abs(from.value), std::abs(to.value));
    const std::complex<double> change = to.value - from.value;
    return !(std::abs(change - ahead * from.slope) > most) && !(std::abs(change - ahead * to.slope) > most);
  });
}

}  // namespace clatter::branches
