#pragma once

#include <cstddef>
#include <optional>

#include "branches/equations/orbit.hpp"
#include "point/problem.hpp"

namespace clatter::branches {

/// The impacts of a run over whole forcing periods from phase 0, and its events on soft stops; nothing if it fails. A
/// problem in the frame of what is shaken, which starts at phase 0.
[[nodiscard]] std::optional<Orbit> event_run(const point::Problem& problem, std::size_t periods);

}  // namespace clatter::branches
