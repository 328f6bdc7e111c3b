#include "sweep/sweep.hpp"

namespace clatter::sweep {

std::size_t size(const Sweep& sweep) {
  std::size_t points = 1;
  for (const Dimension& dimension : sweep.dimensions) points *= length(dimension);
  return points;
}

point::Problem scene_at(const Sweep& sweep, std::size_t point) {
  point::Problem scene = sweep.scene;
  std::optional<double> start_period = sweep.start_period;
  for (auto dimension = sweep.dimensions.rbegin(); dimension != sweep.dimensions.rend(); ++dimension) {
    const std::size_t index = point % length(*dimension);
    point /= length(*dimension);
    for (const Axis& axis : *dimension) {
      if (axis.parameter == Parameter::start_period) {
        start_period = axis.values[index];
      } else {
        set(scene, axis.parameter, axis.values[index]);
      }
    }
  }
  if (start_period) set(scene, Parameter::start_period, *start_period);  // last: it depends on the stops
  return scene;
}

}  // namespace clatter::sweep
