#pragma once

#include <vector>

#include "branches/walk/violation.hpp"

namespace clatter::branches {

/// The violations of an orbit under dry friction: of its impacts and halts, then of its flights, each of which goes one
/// way, up to its end, and meets no stop before.
[[nodiscard]] std::vector<Violation> slip_violations(const FollowedScene& scene, const Orbit& orbit,
                                                     std::optional<std::size_t> grazing);

/// Whether all that an orbit does is to slip from stick to stick, each time for less than some of the forcing phase,
/// rad.
[[nodiscard]] bool hardly_slips(const FollowedScene& scene, const Orbit& orbit, double less_than);

/// The orbit with a stick in each flight in which the velocity falls to 0 before the end.
[[nodiscard]] Orbit with_halts(const FollowedScene& scene, const Orbit& orbit);

}  // namespace clatter::branches
