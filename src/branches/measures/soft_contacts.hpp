#pragma once

#include "branches/measures/moving.hpp"

namespace clatter::branches {

/// The effect of soft stops on a motion in the time that is kept of it, per unit mass.
struct SoftContacts {
  Along loss = 0;        ///< of energy (eq. 54)
  Along re = 0, im = 0;  ///< of the integral of their force times e^{-i phase}
};
/// By Gauss-Legendre quadrature over each contact, exact to rounding.
[[nodiscard]] SoftContacts soft_contacts(const Moving& moving);

}  // namespace clatter::branches
