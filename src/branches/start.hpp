#pragma once

#include <cstdint>
#include <stdexcept>

#include "branches/orbit.hpp"
#include "point/problem.hpp"

namespace clatter::branches {

/// Why a start can't be followed, and what to set instead.
struct StartError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The periodic motion that a branch begins with: that which the scene settles on, or, for a period > 0 in forcing
/// periods, that near x0, v0; kept as a half if it is its own mirror image and `symmetric` scenes follow. Motion that
/// rests is kept as a whole from its release on (`resting_orbit`). Throws StartError.
[[nodiscard]] Orbit start_orbit(const point::Problem& problem, std::int64_t period, bool symmetric);

}  // namespace clatter::branches
