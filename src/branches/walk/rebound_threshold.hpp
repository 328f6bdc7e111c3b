#pragma once

#include <cstddef>
#include <optional>

#include "branches/walk/touch.hpp"

namespace clatter::branches {

/// An impact of an orbit that is slower than the speed from which its stop, or wall, lets the mass rebound; nothing if
/// none is. The equations of an orbit have all impacts rebound, so beyond that speed they are those of no motion.
[[nodiscard]] std::optional<std::size_t> impact_without_rebound(const FollowedScene& scene, const Orbit& orbit);

/// Whether an impact is as fast as that to within a share, so that the smallest change decides if it rebounds.
[[nodiscard]] bool is_at_threshold(const FollowedScene& scene, const Orbit& orbit, double within);

/// The point within a step of a walk at which an impact comes down to that speed.
[[nodiscard]] CurvePoint point_at_threshold(const OrbitEquations& equations, const Walk& walk, const Narrowed& between);

}  // namespace clatter::branches
