#include "branches/start/start_in_housing.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "attractors/periodic_motion.hpp"
#include "branches/equations/housing_flight.hpp"

namespace clatter::branches {
namespace {

/// A strike that takes away the force of a damped stop, or brings it, is one event.
void merge_changes_of_contact(std::vector<OrbitEvent>& events) {
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    const OrbitEvent& next = events[i + 1];
    const bool changes = next.kind == Event::Kind::separation || next.kind == Event::Kind::renewal;
    if (!events[i].is_of_wall() || !changes || next.phase != events[i].phase) continue;
    events[i].contact = presses(next.kind) ? next.side : Side::none;
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(i + 1));
  }
}

/// Adds the loose mass to each event of the main mass, on the way from a strike, at which both are known.
void add_loose_mass(const FollowedScene& scene, Orbit& orbit) {
  with_arcs_of_main(scene, [&]<Effects E>() {
    const HousingFlights<double, E> flights{numbers_of<double>(scene)};
    for (std::size_t i = 0; i + 1 < orbit.size(); ++i) {
      const auto end = flights.end(flight_of_both(orbit, i));
      if (OrbitEvent& event = orbit.events[i + 1]; !event.is_of_wall()) event.other = {end[2], end[3]};
    }
  });
}

}  // namespace

void require_walls_in_range(const FollowedScene& scene, Parameter parameter, const std::array<double, 2>& range) {
  const LooseMass& walls = scene.given.loose;
  if (parameter.is_of_both() && walls.lower != -walls.upper)
    throw SettingError(
        "branch.along = loose_gap moves both walls, which aren't symmetric; take loose_lower or loose_upper");
  if (parameter == Parameter("loose_lower") && range[1] >= walls.upper)
    throw SettingError("branch.range reaches the upper wall; end it below loose_upper");
  if (parameter == Parameter("loose_upper") && range[0] <= walls.lower)
    throw SettingError("branch.range reaches the lower wall; begin it above loose_lower");
}

Orbit start_in_housing(const FollowedScene& scene, const point::Problem& problem, const MotionStart& near,
                       bool symmetric) {
  const auto motion =
      attractors::periodic_motion(problem, near.state, static_cast<std::size_t>(near.periods), near.phase);
  if (!motion) throw StartError("the run from the start fails");
  const attractors::SectionState& from = motion->cycle[0];
  auto orbit = event_run(attractors::started(problem, from, near.phase), motion->cycle.size());
  if (!orbit) throw StartError("the run from the start fails");
  merge_changes_of_contact(orbit->events);
  const auto strike = std::ranges::find_if(orbit->events, &OrbitEvent::is_of_wall);
  if (strike == orbit->events.end())
    throw StartError(
        "the loose mass meets no wall from the start on: then it stays wherever it is, and no branch of such motion is "
        "followed; set loose_x0 and loose_v0 so that it strikes, or shake harder");
  const bool has_stops = std::isfinite(scene.stops.lower) || std::isfinite(scene.stops.upper);
  if (is_anywhere(scene, *orbit) && has_stops)
    throw StartError(
        "without a spring, a main mass that meets no stop may be anywhere between them, and no branch of such motion "
        "is "
        "followed; begin where it meets one, or leave the stops out");
  for (OrbitEvent& event : orbit->events) {
    if (event.before == 0 && is_impact(event.kind))
      throw StartError(
          std::string(event.is_of_wall() ? "a wall presses the loose mass in" : "the main mass rests on a stop in") +
          " the motion at the start, and no branch of such motion is followed; begin where it only strikes, or sweep "
          "the parameter with follow instead");
    event.phase += near.phase;
  }
  *orbit = orbit->from_event(static_cast<std::size_t>(strike - orbit->events.begin()));
  add_loose_mass(scene, *orbit);
  return orbit->half_if_same(1e-6, symmetric);
}

}  // namespace clatter::branches
