#include "branches/equations/linear_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace clatter::branches {

double product(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

Vector sum(const Vector& a, double s, const Vector& b) {
  Vector c = a;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] += s * b[i];
  return c;
}

double largest(const Vector& v) {
  double size = 0;
  for (const double x : v)
    size = std::isfinite(x) ? std::max(size, std::abs(x)) : std::numeric_limits<double>::infinity();
  return size;
}

std::optional<Vector> solve(Matrix matrix, Vector right) {
  const std::size_t n = matrix.rows;
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0;
    for (std::size_t j = 0; j < n; ++j) size = std::max(size, std::abs(matrix(i, j)));
    if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
    for (std::size_t j = 0; j < n; ++j) matrix(i, j) /= size;
    right[i] /= size;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(matrix(i, k)) > std::abs(matrix(pivot, k))) pivot = i;
    if (!(std::abs(matrix(pivot, k)) > 0)) return std::nullopt;
    if (pivot != k) {
      for (std::size_t j = k; j < n; ++j) std::swap(matrix(k, j), matrix(pivot, j));
      std::swap(right[k], right[pivot]);
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = matrix(i, k) / matrix(k, k);
      if (factor == 0) continue;
      for (std::size_t j = k + 1; j < n; ++j) matrix(i, j) -= factor * matrix(k, j);
      right[i] -= factor * right[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) right[k] -= matrix(k, j) * right[j];
    right[k] /= matrix(k, k);
  }
  return right;
}

}  // namespace clatter::branches
