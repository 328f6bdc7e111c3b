#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

namespace clatter::motion {

/// Four numbers of a motion with a loose mass, or a small change of them: x, x', y, y'.
template <class Number>
using Four = std::array<Number, 4>;
/// A linear map of small changes (dx, dx', dy, dy'), by rows.
using LooseJacobian = std::array<Four<double>, 4>;

/// The eigenvalues of a map, the larger modulus first, of a pair the one with the positive imaginary part; NaN if an
/// entry is not finite.
[[nodiscard]] std::array<std::complex<double>, 4> multipliers_of(const LooseJacobian& map);

/// Those that are known of multipliers, the larger first, of a map without its power of two: beside one so large that
/// its rounding is above 1 smaller ones have no digits, and are NaN.
[[nodiscard]] std::array<std::complex<double>, 4> known_of(std::array<std::complex<double>, 4> multipliers,
                                                           double power = 0.0);

/// How the fixed point of a map changes with a number: the solution d of (1 - M) d = dP, with M the map's derivative by
/// its point and dP that of its value by the number. With dP = P(s) - s it is the step of Newton's method from s. Not
/// finite if there is none.
[[nodiscard]] Four<double> change_of_fixed_point(const LooseJacobian& map, const Four<double>& by_number);

/// Logarithm of the largest factor by which a map stretches a change.
[[nodiscard]] double log_norm(const LooseJacobian& map);

/// A norm in which a map multiplies each change along an eigenvector by the modulus of its eigenvalue: the largest
/// coordinate along eigenvectors of length 1, or the length of what is left beside them, which the map takes at once.
class EigenNorm {
 public:
  /// Nothing if the map isn't finite, or two eigenvectors nearly coincide.
  [[nodiscard]] static std::optional<EigenNorm> of(const LooseJacobian& map);

  [[nodiscard]] double spectral_radius() const { return spectral_radius_; }
  [[nodiscard]] double size_of(const Four<double>& change) const;
  /// Changes of size 1: the eigenvectors, of a pair real and imaginary part.
  [[nodiscard]] std::vector<Four<double>> directions() const;

 private:
  using Vector = std::array<std::complex<double>, 4>;
  struct Pair {
    Vector along{}, across{};  ///< of a change, across times it is its coordinate along `along`
    bool is_turning = false;   ///< one of two conjugate ones, the other of which isn't kept
  };
  double spectral_radius_ = 0.0;
  std::vector<Pair> pairs_{};
};

}  // namespace clatter::motion
