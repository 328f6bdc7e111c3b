#include "branches/curve_graze.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "branches/walk/touch.hpp"

namespace clatter::branches {

std::size_t slowest_impact(const Orbit& orbit) {
  const auto slow = std::ranges::min_element(orbit.events, {}, [](const OrbitEvent& event) {
    return is_impact(event.kind) ? std::abs(event.before) : std::numeric_limits<double>::infinity();
  });
  return static_cast<std::size_t>(slow - orbit.events.begin());
}

std::optional<std::size_t> shortest_contact(const Orbit& orbit) {
  constexpr double is_short = 1e-2;  // rad
  std::optional<std::size_t> found;
  double least = is_short;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent from = orbit.event(i), to = orbit.event(i + 1);
    const bool contact = to.kind == Event::Kind::separation && presses(from.kind),
               interruption = presses(to.kind) && from.kind == Event::Kind::separation && from.side == to.side;
    if ((contact || interruption) && to.phase - from.phase < least) least = to.phase - from.phase, found = i;
  }
  return found;
}

void make_once(SpecialPoint& graze, bool symmetric_scenes) {
  Orbit& orbit = graze.at.orbit;
  const FollowedScene& scene = graze.at.scene;
  const std::size_t event = graze.condition.event;
  if (!is_impact(orbit.events[event].kind)) return;  // is so already
  if (!has_friction(scene.friction)) {
    orbit = orbit.once_with_graze(slowest_impact(orbit), symmetric_scenes);
    graze.condition = {Condition::Kind::graze, 1, slowest_impact(orbit)};
    return;
  }
  orbit = halting_at_stop(scene, orbit, event).half_if_same(1e-6, symmetric_scenes);
  const std::size_t halt = event % orbit.size();
  graze.condition = {
      .kind = Condition::Kind::on_stop, .event = halt, .without = {}, .side = opposite(orbit.events[halt].side)};
}

}  // namespace clatter::branches
