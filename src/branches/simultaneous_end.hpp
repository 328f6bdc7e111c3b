#pragma once

#include <deque>
#include <optional>

#include "branches/waiting.hpp"
#include "branches/walk/touch.hpp"

namespace clatter::branches {

/// Whether two events of a motion, each of another mass, are about to change places.
[[nodiscard]] bool has_events_at_once(const Orbit& orbit);

/// The point within a step of a walk at which a flight meets a stop or a wall just as it ends with an event of the
/// other mass; nothing if it can't be reached.
[[nodiscard]] std::optional<CurvePoint> point_at_once(const OrbitEquations& equations, const Walk& walk,
                                                      const Narrowed& between);

/// Ends a branch there. If motion goes on with the two events in the other order, as it may at a soft stop, that waits.
void end_at_once(const Equations& builder, const BranchPoint& last, bool symmetric_scene, double tolerance,
                 Record& record, std::deque<Waiting>& waiting, std::int64_t generation);

}  // namespace clatter::branches
