#include "sweep/sweep.hpp"

#include <algorithm>

namespace clatter::sweep {

void enter_shaken_frame(point::Problem& problem) {
  if (!is_shaken(problem.shaking)) return;
  const auto [amplitude, lead] = force_in_frame(problem.oscillator, problem.shaking);
  problem.oscillator.forcing = amplitude, problem.shaking.lead = lead;
  problem.start.phase += lead, problem.observe.section_phase += lead;
}

bool is_shaken(const Sweep& sweep) {
  const auto shakes = [](const Axis& axis) {
    const bool is_amplitude =
        axis.parameter == Parameter::stop_amplitude || axis.parameter == Parameter::base_amplitude;
    return is_amplitude && std::ranges::any_of(axis.values, [](double value) { return value != 0; });
  };
  return is_shaken(sweep.problem.shaking) || std::ranges::any_of(sweep.dimensions, [&](const Dimension& dimension) {
           return std::ranges::any_of(dimension, shakes);
         });
}

std::size_t size_one_way(const Sweep& sweep) {
  std::size_t points = 1;
  for (const Dimension& dimension : sweep.dimensions) points *= length(dimension);
  return points;
}

point::Problem problem_at(const Sweep& sweep, std::size_t point) {
  point::Problem problem = sweep.problem;
  std::optional<double> start_period = sweep.start_period;
  std::optional<Machine> machine = sweep.machine;
  each_coordinate(sweep, point, [&](const Axis& axis, double value) {
    if (axis.parameter == Parameter::start_period) {
      start_period = value;
    } else if (!machine || !set(*machine, axis.parameter, value)) {
      set(problem, axis.parameter, value);
    }
  });
  if (start_period) set(problem, Parameter::start_period, *start_period);  // last: it depends on the stops
  if (machine) to_computed_units(problem, *machine);
  enter_shaken_frame(problem);
  if (!machine) to_computed_units(problem);
  return problem;
}

}  // namespace clatter::sweep
