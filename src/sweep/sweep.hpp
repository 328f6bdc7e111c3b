#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "point/problem.hpp"
#include "scene/parameter.hpp"

namespace clatter::sweep {

/// A scene as its user gives it, and how it is run and observed.
struct GivenProblem : GivenScene, point::RunSettings {
  GivenProblem() = default;
  GivenProblem(const point::Problem& problem) : GivenScene(problem), RunSettings(problem) {}
};

/// One swept parameter and its values.
struct Axis {
  Parameter parameter;
  std::vector<double> values;
  bool is_sample = false;  ///< they are a sample of a range, in no order
};

/// Axes of equal length that run together; named by the first.
using Dimension = std::vector<Axis>;

/// The order in which a followed dimension is run; `both`: up, and from there down.
enum class Direction : std::uint8_t { up, down, both };

/// In the order of `Direction`.
inline constexpr std::array<std::string_view, 3> direction_names{"up", "down", "both"};

/// Every combination of the dimensions' values; the first dimension varies slowest, the two directions slower still.
struct Sweep {
  GivenProblem problem{};               ///< the problem that the axes vary
  std::vector<Dimension> dimensions{};  ///< empty: one point
  std::optional<std::size_t> follow{};  ///< the dimension along which each point starts from the end of the one before
  Direction direction = Direction::up;  ///< along `follow`
};

[[nodiscard]] inline std::size_t length(const Dimension& dimension) { return dimension.front().values.size(); }

/// The name of a dimension: the key of its first axis.
[[nodiscard]] inline std::string_view name_of(const Dimension& dimension) { return dimension.front().parameter.key(); }

/// Number of points in each direction.
[[nodiscard]] std::size_t size_one_way(const Sweep& sweep);

/// Number of points.
[[nodiscard]] inline std::size_t size(const Sweep& sweep) {
  return size_one_way(sweep) * (sweep.direction == Direction::both ? 2 : 1);
}

/// Calls `take(axis, value)` for each axis at a point.
template <class Take>
void each_coordinate(const Sweep& sweep, std::size_t point, const Take& take) {
  std::size_t stride = size_one_way(sweep), rest = point % stride;
  for (const Dimension& dimension : sweep.dimensions) {
    stride /= length(dimension);
    const std::size_t index = rest / stride;
    rest %= stride;
    for (const Axis& axis : dimension) take(axis, axis.values[index]);
  }
}

/// Whether stops or base are shaken at any point.
[[nodiscard]] bool is_shaken(const Sweep& sweep);
/// Whether a stop moves by itself at some point.
[[nodiscard]] bool move_by_themselves(const Sweep& sweep);

/// Whether there is a loose mass at any point.
[[nodiscard]] bool has_loose_mass(const Sweep& sweep);

/// Puts the force in the moving frame in place of the one that was given (eqs. 39 to 41); phases that the user gave are
/// those of the force that was given.
void enter_shaken_frame(point::Problem& problem);

/// A problem in the units that it is computed in; of a shaken scene that in the moving frame.
[[nodiscard]] point::Problem computed(const GivenProblem& given);

/// The problem of a point, 0 <= point < size(sweep), in row-major order of the directions and dimensions, as it is
/// computed.
[[nodiscard]] point::Problem problem_at(const Sweep& sweep, std::size_t point);

}  // namespace clatter::sweep
