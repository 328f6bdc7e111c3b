#include <array>
#include <cmath>
#include <vector>

#include "branches/equations.hpp"
#include "branches/links.hpp"

namespace clatter::branches {
namespace {

using namespace clatter::branches::detail;

template <class Number>
std::vector<Link<double>> links_of(const ShakenScene& scene, const Orbit& orbit) {
  return with_arcs(scene, [&]<Effects E>() {
    const Flights<Number, E> flights{Parameters<Number>(scene)};
    std::vector<Link<double>> links;
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const FlightEnd<Number> end = flights.fly(flight_of<Number>(orbit, i));
      links.push_back(link_of(end.beyond.slope, end.velocity.slope, last_is_mirrored(orbit, i)));
    }
    return links;
  });
}

ImpactMap map_of(const std::vector<Link<double>>& links, double determinant) {
  ImpactMap map{.determinant = determinant};
  Square<double> matrix{{{1, 0}, {0, 1}}};
  for (const Link<double>& link : links) matrix = product(link.numerator, matrix), map.denominator *= link.denominator;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) map.numerator[i][j] = matrix[i][j];
  return map;
}

}  // namespace

ImpactMap impact_map(const ShakenScene& scene, const Orbit& orbit) {
  const Parameters<double> p(scene);
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

ImpactMap event_map(const ShakenScene& scene, const Orbit& orbit) {
  return map_of(links_of<Dual<double, 3>>(scene, orbit), determinant_of(Parameters<double>(scene), orbit));
}

Vector direction_of_daughter(const ShakenScene& scene, const Orbit& orbit, const Orbit& daughter, double speed_unit) {
  const ImpactMap map = event_map(scene, orbit);
  const auto& m = map.numerator;
  const double c = map.denominator;
  std::array<double, 2> vector{-m[0][1], m[0][0] + c};  // of (M + 1) v = 0, by the larger row
  if (std::hypot(m[1][0], m[1][1] + c) > std::hypot(m[0][1], m[0][0] + c)) vector = {m[1][1] + c, -m[1][0]};
  Vector direction;
  for (const auto& [phase, before] : spread(scene, daughter, vector))
    direction.push_back(phase), direction.push_back(before / speed_unit);
  direction.push_back(0.0);
  const double length = std::sqrt(product(direction, direction));
  for (double& x : direction) x /= length;
  return direction;
}

std::vector<std::array<double, 2>> spread(const ShakenScene& scene, const Orbit& orbit, std::array<double, 2> change) {
  std::vector<std::array<double, 2>> changes{change};
  for (const Link<double>& link : links_of<Dual<double, 3>>(scene, orbit)) {
    const auto& k = link.numerator;
    const auto& [a, b] = changes.back();
    changes.push_back({(k[0][0] * a + k[0][1] * b) / link.denominator, (k[1][0] * a + k[1][1] * b) / link.denominator});
  }
  changes.pop_back();
  return changes;
}

}  // namespace clatter::branches
