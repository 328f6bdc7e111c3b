#pragma once

#include "branches/walk/violation.hpp"

namespace clatter::branches {

/// The first violation of an orbit under dry friction: of its impacts and halts, then of its flights, each of which
/// goes one way, up to its end, and meets no stop before.
[[nodiscard]] std::optional<Violation> slip_violation(const FollowedScene& scene, const Orbit& orbit,
                                                      std::optional<std::size_t> grazing);

/// The orbit with a stick in each flight in which the velocity falls to 0 before the end.
[[nodiscard]] Orbit with_halts(const FollowedScene& scene, const Orbit& orbit);

}  // namespace clatter::branches
