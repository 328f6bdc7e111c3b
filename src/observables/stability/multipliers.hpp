#pragma once

#include <array>
#include <complex>

#include "motion/loose_tangent.hpp"

namespace clatter::observables {

/// The eigenvalues of a map, the larger modulus first, of a pair the one with the positive imaginary part; NaN if an
/// entry is not finite.
[[nodiscard]] std::array<std::complex<double>, 4> multipliers_of(const motion::LooseJacobian& map);

/// Those that are known of multipliers, the larger first, of a map without its power of two: beside one so large that
/// its rounding is above 1 smaller ones have no digits, and are NaN.
[[nodiscard]] std::array<std::complex<double>, 4> known_of(std::array<std::complex<double>, 4> multipliers,
                                                           double power = 0.0);

/// How the fixed point of a map changes with a number: the solution d of (1 - M) d = dP, with M the map's derivative by
/// its point and dP that of its value by the number.
[[nodiscard]] std::array<double, 4> change_of_fixed_point(const motion::LooseJacobian& map,
                                                          const std::array<double, 4>& by_number);

/// Logarithm of the largest factor by which a map stretches a change.
[[nodiscard]] double log_norm(const motion::LooseJacobian& map);

}  // namespace clatter::observables
