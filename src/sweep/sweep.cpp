#include "sweep/sweep.hpp"

namespace clatter::sweep {

std::size_t size_one_way(const Sweep& sweep) {
  std::size_t points = 1;
  for (const Dimension& dimension : sweep.dimensions) points *= length(dimension);
  return points;
}

point::Problem problem_at(const Sweep& sweep, std::size_t point) {
  point::Problem problem = sweep.problem;
  std::optional<double> start_period = sweep.start_period;
  each_coordinate(sweep, point, [&](const Axis& axis, double value) {
    if (axis.parameter == Parameter::start_period) {
      start_period = value;
    } else {
      set(problem, axis.parameter, value);
    }
  });
  if (start_period) set(problem, Parameter::start_period, *start_period);  // last: it depends on the stops
  return problem;
}

}  // namespace clatter::sweep
