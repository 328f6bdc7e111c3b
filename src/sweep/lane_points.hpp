#pragma once

#include <cstddef>

#include "numbers/arch.hpp"
#include "sweep/point.hpp"

namespace clatter {

inline constexpr std::size_t full_crew = 16;  ///< points that run side by side in lanes

/// Whether a point of the exact method can go into lanes: it meets stops, or is a transient, and its scene fits.
[[nodiscard]] bool can_go_into_lanes(const Task& task);

/// Runs a point that can go into lanes so many times, at least once, side by side in those of an instruction set that
/// isn't scalar, on this thread. The result, the same each time; `in_lanes` says whether the scalar kernel had to
/// observe it after all.
[[nodiscard]] PointResult run_in_lanes(const Task& task, std::size_t times, Arch arch, Workshop& workshop);

}  // namespace clatter
