#include "sweep/sweep.hpp"

namespace clatter::sweep {

std::size_t size(const Sweep& sweep) {
  std::size_t points = 1;
  for (const Dimension& dimension : sweep.dimensions) points *= length(dimension);
  return points;
}

point::Problem problem_at(const Sweep& sweep, std::size_t point) {
  point::Problem problem = sweep.problem;
  std::optional<double> start_period = sweep.start_period;
  for (auto dimension = sweep.dimensions.rbegin(); dimension != sweep.dimensions.rend(); ++dimension) {
    const std::size_t index = point % length(*dimension);
    point /= length(*dimension);
    for (const Axis& axis : *dimension) {
      if (axis.parameter == Parameter::start_period) {
        start_period = axis.values[index];
      } else {
        set(problem, axis.parameter, axis.values[index]);
      }
    }
  }
  if (start_period) set(problem, Parameter::start_period, *start_period);  // last: it depends on the stops
  return problem;
}

}  // namespace clatter::sweep
