#pragma once

#include <cstddef>

#include "lanes/block_state.hpp"
#include "lanes/instruction_set.hpp"
#include "point/point.hpp"

namespace clatter::lanes {

inline constexpr std::size_t lanes_per_block = LaneArray::width;  ///< points that run side by side in lanes

/// Whether a point of the exact method can run in lanes: it meets stops, or is a transient without soft ones, and its
/// scene is accepted.
[[nodiscard]] bool accepts(const point::WorkItem& item);

/// Runs an accepted point `times` times, at least once, side by side in the lanes of an instruction set that isn't
/// scalar, on this thread. Returns the result, the same each time; its `in_lanes` is false if the scalar loop had to
/// observe the point.
[[nodiscard]] point::PointResult run_in_lanes(const point::WorkItem& item, std::size_t times, InstructionSet arch,
                                              point::ThreadScratch& scratch);

}  // namespace clatter::lanes
