#pragma once

#include <array>
#include <complex>

#include "motion/loose_tangent.hpp"

namespace clatter::observables {

/// The eigenvalues of a map, the larger modulus first, of a pair the one with the positive imaginary part; NaN if an
/// entry is not finite.
[[nodiscard]] std::array<std::complex<double>, 4> multipliers_of(const motion::LooseJacobian& map);

/// Logarithm of the largest factor by which a map stretches a change.
[[nodiscard]] double log_norm(const motion::LooseJacobian& map);

}  // namespace clatter::observables
