#include "sweep/sweep.hpp"

#include <algorithm>
#include <numbers>

namespace clatter::sweep {

void enter_shaken_frame(point::Problem& problem) {
  if (is_shaken(problem.shaking) || move_by_themselves(problem.stops))
    static_cast<Scene&>(problem) = in_shaken_frame(problem);
  problem.observe.section_phase += problem.shaking.lead;
}

bool is_shaken(const Sweep& sweep) {
  const auto shakes = [](const Axis& axis) {
    return axis.parameter.role() == Role::shaking &&
           std::ranges::any_of(axis.values, [](double value) { return value != 0; });
  };
  return is_shaken(sweep.problem.shaking) || std::ranges::any_of(sweep.dimensions, [&](const Dimension& dimension) {
           return std::ranges::any_of(dimension, shakes);
         });
}

bool move_by_themselves(const Sweep& sweep) {
  const auto moves = [](const Axis& axis) {
    return axis.parameter.role() == Role::stop_motion && axis.parameter.row().quantity == Quantity::length &&
           std::ranges::any_of(axis.values, [](double value) { return value != 0; });
  };
  return move_by_themselves(sweep.problem.stops) ||
         std::ranges::any_of(sweep.dimensions,
                             [&](const Dimension& dimension) { return std::ranges::any_of(dimension, moves); });
}

bool has_loose_mass(const Sweep& sweep) {
  const auto gives_mass = [](const Axis& axis) {
    return axis.parameter == Parameter("loose_mass") &&
           std::ranges::any_of(axis.values, [](double value) { return value != 0; });
  };
  return has_loose_mass(sweep.problem.loose) || std::ranges::any_of(sweep.dimensions, [&](const Dimension& dimension) {
           return std::ranges::any_of(dimension, gives_mass);
         });
}

std::size_t size_one_way(const Sweep& sweep) {
  std::size_t points = 1;
  for (const Dimension& dimension : sweep.dimensions) points *= length(dimension);
  return points;
}

namespace {

point::Problem problem_of(const GivenScene& given, const point::RunSettings& settings) {
  const auto [scene, units] = clatter::computed(given);
  point::Problem problem{scene, settings, units};
  problem.given = given;
  problem.time.duration /= units.time;
  problem.observe.base_frequency *= units.is_si ? 2 * std::numbers::pi * units.time : units.time;
  enter_shaken_frame(problem);
  return problem;
}

}  // namespace

point::Problem computed(const GivenProblem& given) { return problem_of(given, given); }

point::Problem problem_at(const Sweep& sweep, std::size_t point) {
  GivenScene given = sweep.problem;
  each_coordinate(sweep, point, [&](const Axis& axis, double value) { set(given, axis.parameter, value); });
  return problem_of(given, sweep.problem);
}

}  // namespace clatter::sweep
