#include <array>
#include <cmath>
#include <vector>

#include "branches/equations/equations.hpp"
#include "branches/equations/links.hpp"

namespace clatter::branches {

using namespace clatter::branches::detail;

ImpactMap impact_map(const FollowedScene& scene, const Orbit& orbit) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  if (orbit.size() == 0) {  // free motion around the response
    ImpactMap map{.determinant = determinant_of(p, orbit)};
    with_arcs(scene, [&]<Effects E>() {
      const Flights<double, E> flights{p};
      flights.with_constants(orbit.pressed, [&](const auto& constants) {
        const motion::Propagator<double> free = constants.propagator(orbit.advance() / constants.nu);
        const double sign = orbit.mirrored ? -1 : 1;
        map.numerator[0][0] = sign * free.a, map.numerator[0][1] = sign * free.b;
        map.numerator[1][0] = -sign * constants.spring(free.b), map.numerator[1][1] = sign * free.c;
      });
    });
    return map;
  }
  if (orbit.meets_soft_stop()) return map_of(links_of_states(scene, orbit, p, false), determinant_of(p, orbit));
  return event_map(scene, orbit);
}

}  // namespace clatter::branches
