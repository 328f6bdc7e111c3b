#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "branches/equations/equations.hpp"
#include "branches/equations/housing_multipliers.hpp"
#include "branches/equations/links.hpp"

namespace clatter::branches {

using namespace clatter::branches::detail;

namespace {

/// A number with its derivatives by phase and velocity at the beginning of a flight and by the phase at its end.
using Three = Dual<double, 3>;

/// Whether the phases of sticks are told, too: they change nothing later, so the map of events leaves them out.
enum class Sticks : std::uint8_t { without_phase, with_phase };

std::vector<Link<double>> links_of(const FollowedScene& scene, const Orbit& orbit, Sticks sticks) {
  return with_arcs(scene, [&]<Effects E>() {
    const Flights<Three, E> flights{numbers_of<Three>(scene)};
    std::vector<Link<double>> links;
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const FlightEnd<Three> end = flights.fly(flight_of<Three>(orbit, i));
      const Event::Kind kind = orbit.event(i + 1).kind;
      const bool as_any_halt =
          sticks == Sticks::with_phase && kind == Event::Kind::stick && end.beyond.slope[by_end] != 0;
      links.push_back(link_of(end.beyond.slope, end.coordinate.slope, orbit.ends_mirrored(i),
                              as_any_halt ? Event::Kind::reversal : kind));
    }
    return links;
  });
}

/// The changes of all events, and once more that of the first one, a period later.
std::vector<std::array<double, 2>> spread_round(const FollowedScene& scene, const Orbit& orbit,
                                                std::array<double, 2> change) {
  std::vector<std::array<double, 2>> changes{change};
  for (const Link<double>& link : links_of(scene, orbit, Sticks::with_phase)) {
    const auto& k = link.numerator;
    const auto& [a, b] = changes.back();
    changes.push_back({(k[0][0] * a + k[0][1] * b) / link.denominator, (k[1][0] * a + k[1][1] * b) / link.denominator});
  }
  return changes;
}

}  // namespace

ImpactMap event_map(const FollowedScene& scene, const Orbit& orbit) {
  return map_of(links_of(scene, orbit, Sticks::without_phase), determinant_of(numbers_of<double>(scene), orbit));
}

Vector direction_of_daughter(const FollowedScene& scene, const Orbit& orbit, const Orbit& daughter, double speed_unit) {
  if (has_loose_mass(scene.loose)) return direction_of_daughter_in_housing(scene, orbit, daughter, speed_unit);
  const ImpactMap map = event_map(scene, orbit);
  const auto& m = map.numerator;
  const double c = map.denominator;
  std::array<double, 2> vector{-m[0][1], m[0][0] + c};  // of (M + 1) v = 0, by the larger row
  if (std::hypot(m[1][0], m[1][1] + c) > std::hypot(m[0][1], m[0][0] + c)) vector = {m[1][1] + c, -m[1][0]};
  std::vector<std::array<double, 2>> changes = spread_round(scene, daughter, vector);
  if (daughter.events[0].kind == Event::Kind::stick) changes.front() = changes.back();  // now with its phase
  changes.pop_back();
  Vector direction;
  for (const auto& [phase, before] : changes) direction.push_back(phase), direction.push_back(before / speed_unit);
  direction.push_back(0.0);
  const double length = std::sqrt(product(direction, direction));
  for (double& x : direction) x /= length;
  return direction;
}

std::vector<std::array<double, 2>> spread(const FollowedScene& scene, const Orbit& orbit,
                                          std::array<double, 2> change) {
  std::vector<std::array<double, 2>> changes = spread_round(scene, orbit, change);
  changes.pop_back();
  return changes;
}

}  // namespace clatter::branches
