#include "branches/waiting.hpp"

#include "branches/walk/graze.hpp"

namespace clatter::branches {

void no_longer_waits(std::deque<Waiting>& waiting, std::size_t special, const Orbit& orbit) {
  std::erase_if(waiting,
                [&](const Waiting& one) { return one.special == special && one.orbit.word() == orbit.word(); });
}

std::optional<Vector> first_step(const OrbitEquations& equations, const CurvePoint& start, const Waiting& from,
                                 double tolerance) {
  std::vector<Vector> tried;
  if (from.direction) {
    tried = {*from.direction};
  } else {
    Vector axis(equations.unknowns(), from.heading == 0 ? 1.0 : 0.0);
    if (from.heading != 0) axis.back() = from.heading;
    const auto along = tangent(equations, start.at, axis);
    if (!along) return std::nullopt;
    tried = {*along};
    if (from.heading == 0) tried.push_back(sum(*along, -2.0, *along));
  }
  return direction_into_motion(equations, start.at, tried, tolerance);
}

}  // namespace clatter::branches
