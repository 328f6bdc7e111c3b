#pragma once

#include "branches/measures/moving.hpp"

namespace clatter::branches {

/// The integral of a force times e^{-i phase} over the time that is kept of a motion, per unit mass.
struct Harmonic {
  Along re = 0, im = 0;
};
/// The harmonic of the force of friction, in closed form: mu against each slip, and in a stick all that holds the mass,
/// a soft stop, too.
[[nodiscard]] Harmonic friction_harmonic(const Moving& moving);

}  // namespace clatter::branches
