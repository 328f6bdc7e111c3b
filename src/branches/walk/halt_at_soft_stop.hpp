#pragma once

#include <vector>

#include "branches/walk/halt_change.hpp"

/// Halts under dry friction on the position of a soft stop.
namespace clatter::branches {

/// The soft stop on whose position a mass halts.
[[nodiscard]] Side soft_stop_at_halt(const FollowedScene& scene, const OrbitEvent& halt);

/// The acceleration of a mass that halts, as it slips towards a side.
[[nodiscard]] double acceleration_from(const FollowedScene& scene, const OrbitEvent& halt, Side side);

/// An orbit with a halt on the position of a soft stop as if it were a little beyond that, or before it, as far as the
/// mass slips in `advance` of the phase before it. What there is between it and the position then are a touch or a
/// separation where the mass passes that, and a renewal where the stop catches up with it.
[[nodiscard]] Orbit with_halt_beside(const FollowedScene& scene, const Orbit& orbit, std::size_t number, double advance,
                                     bool within);

/// Adds the changes at which halts come to the position of a soft stop: those beside violations, and those that the
/// mass comes to, or leaves, across that position in a short time.
void add_passing(const FollowedScene& scene, const Orbit& orbit, const std::vector<Violation>& violations,
                 std::vector<HaltChange>& changes);

}  // namespace clatter::branches
