#pragma once

#include <cstddef>

#include "lanes/instruction_set.hpp"
#include "point/point.hpp"

namespace clatter::lanes {

inline constexpr std::size_t lanes_per_block = 16;  ///< points that run side by side in lanes

/// Whether a point of the exact method can go into lanes: it meets stops, or is a transient, and its scene fits.
[[nodiscard]] bool accepts(const point::WorkItem& item);

/// Runs a point that can go into lanes so many times, at least once, side by side in those of an instruction set that
/// isn't scalar, on this thread. The result, the same each time; `in_lanes` says whether the scalar kernel had to
/// observe it after all.
[[nodiscard]] point::PointResult run_in_lanes(const point::WorkItem& item, std::size_t times, InstructionSet arch,
                                              point::ThreadScratch& scratch);

}  // namespace clatter::lanes
