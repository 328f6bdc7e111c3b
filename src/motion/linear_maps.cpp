#include "motion/linear_maps.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::motion {
namespace {

Eigen::Matrix4d matrix_of(const LooseJacobian& map) {
  Eigen::Matrix4d matrix;
  for (Eigen::Index row = 0; row < 4; ++row)
    for (Eigen::Index column = 0; column < 4; ++column)
      matrix(row, column) = map[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  return matrix;
}

}  // namespace

std::array<std::complex<double>, 4> multipliers_of(const LooseJacobian& map) {
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

Four<double> change_of_fixed_point(const LooseJacobian& map, const Four<double>& by_number) {
  const Eigen::Map<const Eigen::Vector4d> right(by_number.data());
  const Eigen::Vector4d change = (Eigen::Matrix4d::Identity() - matrix_of(map)).partialPivLu().solve(right);
  return {change[0], change[1], change[2], change[3]};
}

double log_norm(const LooseJacobian& map) {
  const Eigen::Matrix4d matrix = matrix_of(map);
  if (!matrix.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return std::log(Eigen::JacobiSVD<Eigen::Matrix4d>(matrix).singularValues()[0]);
}

std::optional<EigenNorm> EigenNorm::of(const LooseJacobian& map) {
  constexpr double gone = 1e-8, nearly_coincide = 1e-6;
  const Eigen::Matrix4d matrix = matrix_of(map);
  if (!matrix.allFinite()) return std::nullopt;
  const Eigen::EigenSolver<Eigen::Matrix4d> right(matrix), left(matrix.transpose());
  if (right.info() != Eigen::Success || left.info() != Eigen::Success) return std::nullopt;
  EigenNorm norm;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const std::complex<double> value = right.eigenvalues()[i];
    norm.spectral_radius_ = std::max(norm.spectral_radius_, std::abs(value));
    if (std::abs(value) < gone || value.imag() < 0) continue;
    Eigen::Index same = 0;
    (left.eigenvalues().array() - value).abs().minCoeff(&same);
    const Eigen::Vector4cd along = right.eigenvectors().col(i).normalized();
    Eigen::Vector4cd across = left.eigenvectors().col(same).normalized();
    const std::complex<double> product = across.transpose() * along;
    if (!(std::abs(product) > nearly_coincide)) return std::nullopt;
    across /= product;
    Pair pair{.is_turning = value.imag() > 0};
    for (Eigen::Index k = 0; k < 4; ++k)
      pair.along[static_cast<std::size_t>(k)] = along[k], pair.across[static_cast<std::size_t>(k)] = across[k];
    norm.pairs_.push_back(pair);
  }
  return norm;
}

double EigenNorm::size_of(const Four<double>& change) const {
  Four<double> left = change;
  double size = 0.0;
  for (const Pair& pair : pairs_) {
    std::complex<double> coordinate = 0.0;
    for (std::size_t k = 0; k < change.size(); ++k) coordinate += pair.across[k] * change[k];
    const double times = pair.is_turning ? 2.0 : 1.0;  // beside its conjugate
    for (std::size_t k = 0; k < change.size(); ++k) left[k] -= times * (coordinate * pair.along[k]).real();
    size = std::max(size, times * std::abs(coordinate));
  }
  double square = 0.0;
  for (const double number : left) square += number * number;
  return std::max(size, std::sqrt(square));
}

std::vector<Four<double>> EigenNorm::directions() const {
  std::vector<Four<double>> found;
  for (const Pair& pair : pairs_) {
    Four<double> real, imaginary;
    for (std::size_t k = 0; k < real.size(); ++k) real[k] = pair.along[k].real(), imaginary[k] = pair.along[k].imag();
    found.push_back(real);
    if (pair.is_turning) found.push_back(imaginary);
  }
  return found;
}

}  // namespace clatter::motion
