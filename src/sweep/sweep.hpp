#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "point/problem.hpp"
#include "sweep/parameter.hpp"
#include "sweep/scaling.hpp"

namespace clatter::sweep {

/// Sets a parameter of the scene. `xs` and `gap` set both stops to -|xs| and +|xs|, `R` both restitutions,
/// `stop_stiffness` and `stop_damping` those of both stops; `start_period` sets x0 and v0 from the lower stop, v0 =
/// |xs| cot(start_period / 4) (eq. 36), so it is set after the stops.
void set(point::Problem& scene, Parameter parameter, double value);

/// Sets a parameter of a machine; returns false if it isn't one of mass, spring, damper and force.
[[nodiscard]] bool set(Machine& machine, Parameter parameter, double value);

/// One swept parameter and its values.
struct Axis {
  Parameter parameter = Parameter::nu;
  std::vector<double> values;
  Quantity quantity = quantity_of(parameter);  ///< that they are in SI
};

/// Axes of equal length that run together; named by the first.
using Dimension = std::vector<Axis>;

/// The order in which a followed dimension is run; `both`: up, and from there down.
enum class Direction : std::uint8_t { up, down, both };

/// In the order of `Direction`.
inline constexpr std::array<std::string_view, 3> direction_names{"up", "down", "both"};

/// Every combination of the dimensions' values; the first dimension varies slowest, the two directions slower still.
struct Sweep {
  point::Problem problem{};             ///< the problem that the axes vary
  std::vector<Dimension> dimensions{};  ///< empty: one point
  std::optional<std::size_t> follow{};  ///< the dimension along which each point starts from the end of the one before
  Direction direction = Direction::up;  ///< along `follow`
  std::optional<double>
      start_period{};  ///< start_period of [scene], set at each point after its stops; empty: x0 and v0 are the start
  std::optional<Machine>
      machine{};  ///< in SI, in place of the oscillator of the problem, whose other numbers are in SI too
};

[[nodiscard]] inline std::size_t length(const Dimension& dimension) { return dimension.front().values.size(); }

/// The name of a dimension: the key of its first axis.
[[nodiscard]] inline std::string_view name_of(const Dimension& dimension) {
  return key_of(dimension.front().parameter);
}

/// Number of points in each direction.
[[nodiscard]] std::size_t size_one_way(const Sweep& sweep);

/// Number of points.
[[nodiscard]] inline std::size_t size(const Sweep& sweep) {
  return size_one_way(sweep) * (sweep.direction == Direction::both ? 2 : 1);
}

/// Calls `take(axis, value)` for each axis at a point.
template <class Take>
void each_coordinate(const Sweep& sweep, std::size_t point, const Take& take) {
  std::size_t stride = size_one_way(sweep);
  for (const Dimension& dimension : sweep.dimensions) {
    stride /= length(dimension);
    const std::size_t index = point / stride % length(dimension);
    for (const Axis& axis : dimension) take(axis, axis.values[index]);
  }
}

/// Whether stops or base are shaken at any point.
[[nodiscard]] bool is_shaken(const Sweep& sweep);

/// Puts the force in the moving frame in place of the shaking of a problem as the user gave it (eqs. 39 to 41); phases
/// that the user gave are those of the shaking.
void enter_shaken_frame(point::Problem& problem);

/// The problem of a point, 0 <= point < size(sweep), in row-major order of the directions and dimensions, in the units
/// that it is computed in; of a shaken scene that in the moving frame.
[[nodiscard]] point::Problem problem_at(const Sweep& sweep, std::size_t point);

}  // namespace clatter::sweep
