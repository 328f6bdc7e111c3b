#pragma once

#include "branches/walk/violation.hpp"

namespace clatter::branches {

/// The first violation of an orbit of a loose mass: of its impacts, then of its flights, each of which meets no wall
/// before its end.
[[nodiscard]] std::optional<Violation> housing_violation(const FollowedScene& scene, const Orbit& orbit,
                                                         std::optional<std::size_t> grazing);

}  // namespace clatter::branches
