#include "branches/start/start_in_housing.hpp"

#include "attractors/periodic_motion.hpp"
#include "branches/equations/housing_flight.hpp"

namespace clatter::branches {
namespace {

/// Makes each impact of a run a strike, with the main mass before it, which moves alone from one to the next.
void add_main_mass(const FollowedScene& scene, const attractors::SectionState& from, double phase, Orbit& orbit) {
  with_arcs_of_main(scene, [&]<Effects E>() {
    const HousingFlights<double, E> flights{numbers_of<double>(scene)};
    const double nu = scene.oscillator.frequency, middle = flights.parameters().middle();
    double place = from.x - middle, v = from.v;
    for (OrbitEvent& impact : orbit.events) {
      const motion::Motion<double> m = flights.main_from(phase, place, v).at((impact.phase - phase) / nu);
      impact.kind = Event::Kind::strike, impact.main = {m.x - middle, m.v};
      phase = impact.phase, place = impact.main.place, v = flights.rule().main_after(m.v, impact.before);
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
  if (orbit->size() == 0)
    throw StartError(
        "the loose mass meets no wall from the start on: then it stays wherever it is, and no branch of such motion is "
        "followed; set loose_x0 and loose_v0 so that it strikes, or shake harder");
  for (OrbitEvent& impact : orbit->events) {
    if (impact.before == 0)
      throw StartError(
          "a wall presses the loose mass in the motion at the start, and no branch of such motion is followed; begin "
          "where it only strikes, or sweep the parameter with follow instead");
    impact.phase += near.phase;
  }
  add_main_mass(scene, from, near.phase, *orbit);
  return orbit->half_if_same(1e-6, symmetric);
}

}  // namespace clatter::branches
