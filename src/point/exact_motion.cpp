#include "point/exact_motion.hpp"

#include "point/exact_points.hpp"
#include "scene/required_effects.hpp"

namespace clatter::point {

std::unique_ptr<ExactMotion> ExactMotion::of(const Problem& problem) {
  const Effects effects = required_effects(problem);
  return with_effects(
      effects, [&]<Effects E>() { return ExactPoints<E>::motion(problem, stops_in_reach(problem.stops, effects)); });
}

}  // namespace clatter::point
