#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace clatter::branches {

using Vector = std::vector<double>;

/// A dense matrix, row by row.
struct Matrix {
  std::size_t rows, columns;
  std::vector<double> elements;

  Matrix(std::size_t height, std::size_t width) : rows(height), columns(width), elements(height * width, 0.0) {}
  double& operator()(std::size_t i, std::size_t j) { return elements[i * columns + j]; }
  double operator()(std::size_t i, std::size_t j) const { return elements[i * columns + j]; }
};

[[nodiscard]] double product(const Vector& a, const Vector& b);
/// a + s b
[[nodiscard]] Vector sum(const Vector& a, double s, const Vector& b);
/// The largest modulus; infinite if an element isn't finite.
[[nodiscard]] double largest(const Vector& v);

/// Solves a square system by Gaussian elimination; each pivot is the largest of its column in rows scaled to a like
/// size. Nothing if the matrix is singular.
[[nodiscard]] std::optional<Vector> solve(Matrix matrix, Vector right);

}  // namespace clatter::branches
