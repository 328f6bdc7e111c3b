#include "branches/walk/resonance.hpp"

#include <algorithm>
#include <cmath>

#include "branches/equations/flight.hpp"

namespace clatter::branches {

bool may_resonate_between(const OrbitEquations& equations, const Vector& one, const Vector& other) {
  const Orbit& orbit = equations.shape();
  const OrbitEquations::Axis& axis = equations.axes().front();
  if (orbit.size() > 0 || has_loose_mass(equations.scene_at(one).loose)) return false;
  const auto amplitude = [&](const Vector& at) {
    const FollowedScene scene = equations.scene_at(at);
    return with_arcs(scene, [&]<Effects E>() -> Along {
      const Flights<Along, E> flights{numbers_along(scene, axis.parameter)};
      return flights.with_response(orbit.pressed, [](const auto&, const Response<Along>& r) { return r.amplitude; });
    });
  };
  constexpr double rough =
      0.5;  // of the amplitude: from a pole within a step the tangents miss by twice as much or more
  const Along here = amplitude(one), there = amplitude(other);
  const double ahead = (other.back() - one.back()) * axis.unit, most = rough * std::min(here.value, there.value),
               change = there.value - here.value;
  return std::abs(change - ahead * here.slope[0]) > most || std::abs(change - ahead * there.slope[0]) > most;
}

}  // namespace clatter::branches
