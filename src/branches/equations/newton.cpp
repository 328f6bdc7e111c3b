#include "branches/equations/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::branches {
namespace {

/// The equations' slope with one more row.
Matrix bordered(const Matrix& slope, const Vector& row) {
  Matrix matrix(slope.rows + 1, slope.columns);
  std::ranges::copy(slope.elements, matrix.elements.begin());
  std::ranges::copy(row, matrix.elements.end() - static_cast<std::ptrdiff_t>(row.size()));
  return matrix;
}

Vector negative(Vector v) {
  for (double& x : v) x = -x;
  return v;
}

/// Newton's method, as long as each step is shorter than the one before; the last one is a correction of rounding.
template <class StepFrom>
std::optional<Vector> newton(Vector point, double tolerance, StepFrom&& step_from) {
  constexpr int most_iterations = 12;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const std::optional<Vector> step = step_from(point);
    if (!step) return std::nullopt;
    const double length = largest(*step);
    if (!(length < std::max(before, beside_singular))) return std::nullopt;
    point = sum(point, 1.0, *step);
    if (length <= tolerance || (length <= beside_singular && length > before / 8)) return point;
    before = length;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vector> corrected(const OrbitEquations& equations, Vector guess, const Vector& direction,
                                double tolerance) {
  const Vector predicted = guess;
  return newton(std::move(guess), tolerance, [&](const Vector& point) -> std::optional<Vector> {
    const auto here = equations.at(point);
    if (!here) return std::nullopt;
    Vector right = negative(here->residual);
    right.push_back(product(direction, sum(predicted, -1.0, point)));
    return solve(bordered(here->slope, direction), std::move(right));
  });
}

std::optional<Vector> solution(const OrbitEquations& equations, Vector guess, double tolerance) {
  return newton(std::move(guess), tolerance, [&](const Vector& point) -> std::optional<Vector> {
    const auto here = equations.at(point);
    return here ? solve(here->slope, negative(here->residual)) : std::nullopt;
  });
}

std::optional<Vector> tangent(const OrbitEquations& equations, const Vector& point, const Vector& direction) {
  const auto here = equations.at(point);
  if (!here) return std::nullopt;
  Vector right(equations.unknowns(), 0.0);
  right.back() = 1;
  std::optional<Vector> along = solve(bordered(here->slope, direction), std::move(right));
  if (!along || !std::isfinite(largest(*along))) return std::nullopt;
  const double length = std::sqrt(product(*along, *along));
  for (double& x : *along) x /= length;
  return along;
}

}  // namespace clatter::branches
