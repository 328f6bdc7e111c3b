#include "observables/stability/multipliers.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::observables {
namespace {

Eigen::Matrix4d matrix_of(const motion::LooseJacobian& map) {
  Eigen::Matrix4d matrix;
  for (Eigen::Index row = 0; row < 4; ++row)
    for (Eigen::Index column = 0; column < 4; ++column)
      matrix(row, column) = map[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  return matrix;
}

}  // namespace

std::array<std::complex<double>, 4> multipliers_of(const motion::LooseJacobian& map) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::array<std::complex<double>, 4> found;
  found.fill({nan, nan});
  const Eigen::Matrix4d matrix = matrix_of(map);
  if (!matrix.allFinite()) return found;
  const Eigen::EigenSolver<Eigen::Matrix4d> solver(matrix, false);
  if (solver.info() != Eigen::Success) return found;
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = solver.eigenvalues()[static_cast<Eigen::Index>(i)];
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) {
    const double one = std::abs(a), other = std::abs(b);
    return one != other ? one > other : a.imag() > b.imag();
  });
  return found;
}

std::array<std::complex<double>, 4> known_of(std::array<std::complex<double>, 4> multipliers, double power) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), epsilon = std::numeric_limits<double>::epsilon();
  // of the largest: eigenvalues are those of a map that is off by some epsilon of its size, as the method is backward
  // stable, so one less than 1e3 times that has fewer than three digits
  constexpr double lost = 1e3 * epsilon;
  const double largest = std::abs(multipliers[0]);
  if (!(std::log2(epsilon * largest) + power > 0)) return multipliers;
  for (std::complex<double>& multiplier : multipliers)
    if (std::abs(multiplier) < lost * largest) multiplier = {nan, nan};
  return multipliers;
}

std::array<double, 4> change_of_fixed_point(const motion::LooseJacobian& map, const std::array<double, 4>& by_number) {
  const Eigen::Map<const Eigen::Vector4d> right(by_number.data());
  const Eigen::Vector4d change = (Eigen::Matrix4d::Identity() - matrix_of(map)).partialPivLu().solve(right);
  return {change[0], change[1], change[2], change[3]};
}

double log_norm(const motion::LooseJacobian& map) {
  const Eigen::Matrix4d matrix = matrix_of(map);
  if (!matrix.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return std::log(Eigen::JacobiSVD<Eigen::Matrix4d>(matrix).singularValues()[0]);
}

}  // namespace clatter::observables
