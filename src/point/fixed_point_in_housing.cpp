#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "motion/loose_tangent.hpp"
#include "point/every_effect.hpp"
#include "point/fifty_digit_periods.hpp"
#include "point/fixed_point.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::point {
namespace {

constexpr std::size_t n = 4;  // x, x', y, y'
template <class Number>
using Four = std::array<Number, n>;

template <class Number>
Four<Number> numbers_of(const motion::State<Number>& state, const LooseMass& loose) {
  if (state.loose.wall == Side::none) return {state.x, state.v, state.loose.place, state.loose.speed};
  const auto [z, w] = motion::place_in_housing(state, loose);
  return {state.x, state.v, Number(state.x + z), Number(state.v + w)};
}

/// Moves a state; a loose mass that a wall presses stays on it.
void move(motion::State<FiftyDigits>& state, const Four<double>& by) {
  state.x += by[0], state.v += by[1];
  motion::LooseState<FiftyDigits>& loose = state.loose;
  if (loose.wall != Side::none && loose.place == 0 && loose.speed == 0) return;
  const bool is_of_wall = loose.wall != Side::none;
  loose.place += is_of_wall ? by[2] - by[0] : by[2];
  loose.speed += is_of_wall ? by[3] - by[1] : by[3];
}

/// Solves A x = b by elimination with pivots; nothing if A is singular.
std::optional<Four<double>> solution(motion::LooseJacobian A, Four<double> b) {
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row)
      if (std::abs(A[row][column]) > std::abs(A[pivot][column])) pivot = row;
    if (!(std::abs(A[pivot][column]) > 0)) return std::nullopt;
    std::swap(A[pivot], A[column]), std::swap(b[pivot], b[column]);
    for (std::size_t row = column + 1; row < n; ++row) {
      const double factor = A[row][column] / A[column][column];
      for (std::size_t i = column; i < n; ++i) A[row][i] -= factor * A[column][i];
      b[row] -= factor * b[column];
    }
  }
  for (std::size_t row = n; row-- > 0;) {
    for (std::size_t i = row + 1; i < n; ++i) b[row] -= A[row][i] * b[i];
    b[row] /= A[row][row];
  }
  return b;
}

/// The identity less the derivative of the map over so many periods, in double.
template <Effects E>
std::optional<motion::LooseJacobian> newton_matrix(const Problem& problem, motion::State<double> state,
                                                   std::int64_t periods) {
  stepping::Exact<double, E> integrator(problem, limits_of(problem));
  motion::LooseTangent derivative(problem);
  for (std::int64_t section = 0; section < periods; ++section)
    if (advance_to_section(integrator, state, 0, derivative) != stepping::Outcome::completed) return std::nullopt;
  motion::LooseJacobian matrix = derivative.mantissa();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      matrix[i][j] = (i == j ? 1.0 : 0.0) - std::ldexp(matrix[i][j], static_cast<int>(derivative.exponent()));
  return matrix;
}

/// The derivative in double serves all iterations: each leaves as small a share of the error as its rounding.
template <Effects E>
std::optional<FixedPoint> find_fixed_point(const Problem& problem, const motion::State<double>& near,
                                           std::int64_t periods, const std::function<bool()>& stopped) {
  constexpr int most_iterations = 12;
  const auto matrix = newton_matrix<E>(problem, near, periods);
  if (!matrix) return std::nullopt;
  FixedPoint found;
  found.start.x = near.x, found.start.v = near.v;
  found.start.loose = {near.loose.wall, near.loose.place, near.loose.speed, near.loose.pressed};
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    stepping::NoObserver nobody;
    const auto state = run_periods<stepping::Exact<FiftyDigits, E>>(problem, found, periods, stopped, nobody);
    if (!state) return std::nullopt;
    const auto begin = numbers_of(found.start, problem.loose), end = numbers_of(*state, problem.loose);
    Four<double> off;
    double change = 0.0, size = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      off[i] = static_cast<double>(end[i] - begin[i]);
      change += std::abs(off[i]), size += std::abs(static_cast<double>(end[i]));
    }
    if (change <= 1e-30 * size) return found;
    const auto by = solution(*matrix, off);
    if (!by) return std::nullopt;
    move(found.start, *by);
  }
  return std::nullopt;
}

}  // namespace

std::optional<FixedPoint> fixed_point_in_housing(const Problem& problem, const motion::State<double>& near,
                                                 std::int64_t periods, const std::function<bool()>& stopped) {
  return with_every_effect_and_mass(problem, [&]<Effects E>() -> std::optional<FixedPoint> {
    if constexpr (E.loose) return find_fixed_point<E>(problem, near, periods, stopped);
    return std::nullopt;
  });
}

}  // namespace clatter::point
