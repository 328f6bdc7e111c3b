#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "point/point.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Points that run one after the other: along `follow` a whole chain, else a single point.
struct Chains {
  std::size_t count = 0;                ///< chains
  std::size_t length = 1;               ///< points of a chain
  std::size_t values = 1;               ///< of the followed dimension; in both directions half the length
  std::size_t stride = 1;               ///< between points that are neighbours in the followed dimension
  Direction direction = Direction::up;  ///< along it

  explicit Chains(const Sweep& sweep) : count(size_one_way(sweep)) {
    if (!sweep.follow) return;
    direction = sweep.direction, values = clatter::sweep::length(sweep.dimensions[*sweep.follow]);
    length = direction == Direction::both ? 2 * values : values;
    for (std::size_t d = *sweep.follow + 1; d < sweep.dimensions.size(); ++d)
      stride *= clatter::sweep::length(sweep.dimensions[d]);
    count /= values;
  }
  /// Whether the i-th point of a chain lies on the way back.
  [[nodiscard]] bool returns(std::size_t i) const { return i >= values; }
  /// Index of its value in the followed dimension.
  [[nodiscard]] std::size_t value(std::size_t i) const {
    return returns(i) || direction == Direction::down ? length - 1 - i : i;
  }
  /// Index of the i-th point of a chain.
  [[nodiscard]] std::size_t point(std::size_t chain, std::size_t i) const {
    const std::size_t way = returns(i) ? count * values : 0;
    return way + (chain / stride * values + value(i)) * stride + chain % stride;
  }
  /// Whether a point begins its chain, so that its start is known before anything runs.
  [[nodiscard]] bool begins(std::size_t point) const {
    return point < count * values && point / stride % values == value(0);
  }
};

/// The sweep of one chain alone: each dimension but the followed one has the chain's value.
[[nodiscard]] inline Sweep chain_alone(const Sweep& sweep, const Chains& chains, std::size_t chain) {
  Sweep alone = sweep;
  std::size_t stride = size_one_way(sweep), rest = chains.point(chain, 0) % stride;
  for (std::size_t d = 0; d < alone.dimensions.size(); ++d) {
    stride /= length(sweep.dimensions[d]);
    const std::size_t index = rest / stride;
    rest %= stride;
    if (d != sweep.follow)
      for (Axis& axis : alone.dimensions[d]) axis.values = {axis.values[index]};
  }
  return alone;
}

/// Adds the motion of a shaken base to a start at its phase, times `sign`, if a loose mass makes the ground the frame
/// in which the problem is computed.
inline void add_base(Start& start, const point::Problem& problem, int sign) {
  if (!has_loose_mass(problem.loose) || !is_shaken(problem.shaking)) return;
  const FrameMotion base(problem.shaking, problem.oscillator, start.phase);
  start.displacement += sign * base.displacement(base.at(0.0)), start.velocity += sign * base.velocity(base.at(0.0));
}

/// The end of a point as the next one starts from it: relative to what is shaken, at the phase of the shaking.
[[nodiscard]] inline point::End end_for_next(const point::Problem& problem, point::End end) {
  end.phase -= problem.shaking.lead;
  add_base(end, problem, -1);
  return end;
}

/// Starts a point of a chain from the end of the one before, whose phase is that of the shaking, or from the scene's
/// own start if that one failed. A displacement beyond narrower rigid stops is moved onto the stop, the velocity kept,
/// though the units of time may differ; so is the place of a loose mass beyond narrower walls.
inline void start_from(point::Problem& problem, const std::optional<point::End>& end, const Units& units_of_end) {
  if (end) {
    problem.start = *end;
    const double rate = units_of_end.time != problem.units.time ? problem.units.time / units_of_end.time : 1.0;
    problem.start.velocity *= rate;
    if (has_loose_mass(problem.loose))
      problem.loose.place = end->loose_place, problem.loose.velocity = end->loose_velocity * rate;
    add_base(problem.start, problem, 1);
    if (problem.shaking.lead != 0) problem.start.phase += problem.shaking.lead;
  }
  const StopsNow rigid(rigid_ones(problem.stops), problem.oscillator.frequency, problem.start.phase);
  problem.start.displacement = std::clamp(problem.start.displacement, rigid.lower, rigid.upper);
  problem.loose.place = std::clamp(problem.loose.place, problem.loose.lower, problem.loose.upper);
}

}  // namespace clatter::sweep
