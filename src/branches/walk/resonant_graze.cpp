#include "branches/walk/resonant_graze.hpp"

#include "branches/walk/touch.hpp"

namespace clatter::branches {

double resonance(const OrbitEquations& equations, const Vector& at, int n) {
  const FollowedScene scene = equations.scene_at(at);
  const Orbit orbit = equations.orbit_at(at);
  const std::size_t graze = *equations.grazing();
  if (n == 1) {
    const ImpactMap map = impact_map(scene, with_impact_at_graze(scene, orbit, graze));
    return map.numerator[0][0] + map.numerator[1][1];
  }
  // the element of M^n from velocity to displacement: sin(n phi) / sin(phi) times that of M, cos(phi) = tr M / 2
  // over the root of the determinant
  const ImpactMap map = impact_map(scene, halts(orbit.events[graze].kind) ? orbit : orbit.without(graze));
  const double square = map.trace() * map.trace(), factor = n == 2 ? 0 : n == 3 ? 1 : 2;
  return n == 2 ? map.trace() : square - factor * map.determinant;
}

Orbit grazing_once_in(const FollowedScene& scene, const Orbit& orbit, std::size_t graze, int n) {
  if (n == 1) return with_impact_at_graze(scene, orbit, graze);
  Orbit many = orbit.repeated(n);
  const bool halts_there = halts(orbit.events[graze].kind);
  for (std::size_t i = many.size(); i-- > orbit.size();)
    if (i % orbit.size() == graze && !halts_there) many = many.without(i);
  return with_impact_at_graze(scene, many, graze);
}

}  // namespace clatter::branches
