#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "branches/equations/equations.hpp"

namespace clatter::branches {

/// The unknowns of an event of one of two masses, as `OrbitEvent` has them: its phase, that one's number, and place and
/// velocity of the other.
inline constexpr std::size_t of_event = 4;

/// [row][column], of the four unknowns of an event.
using Square4 = std::array<std::array<double, of_event>, of_event>;

/// One flight: how far its end is from the next event, in each of its numbers, and the derivatives of that by the
/// events that it begins and ends with, as they are kept.
struct HousingLink {
  std::array<double, of_event> residual{};
  Square4 by_begin{}, by_end{};
  std::array<std::array<double, 2>, of_event> by_axis{};  ///< in the user's units
};
[[nodiscard]] std::vector<HousingLink> housing_links(const FollowedScene& scene, const Orbit& orbit,
                                                     const std::vector<OrbitEquations::Axis>& axes);

/// The derivatives of left . J right, the equations' change in one direction: `right` is a change of all events, which
/// the last flight returns `multiplier` times as large.
struct HousingSlopes {
  std::vector<Square4::value_type> by_event{};  ///< [event]
  std::array<double, 2> by_axis{};              ///< in the user's units
};
[[nodiscard]] HousingSlopes housing_slopes(const FollowedScene& scene, const Orbit& orbit,
                                           const std::vector<OrbitEquations::Axis>& axes, const Vector& left,
                                           const Vector& right, int multiplier);

}  // namespace clatter::branches
