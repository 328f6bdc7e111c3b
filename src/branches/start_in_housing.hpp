#pragma once

#include "branches/start.hpp"

namespace clatter::branches {

/// The periodic motion of a loose mass near a state, as `start_orbit` gives it. Throws StartError if it meets no wall
/// or is pressed onto one, as neither is followed.
[[nodiscard]] Orbit start_in_housing(const point::Problem& problem, const MotionStart& near, bool symmetric);

}  // namespace clatter::branches
