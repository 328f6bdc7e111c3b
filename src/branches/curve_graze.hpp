#pragma once

#include <cstddef>
#include <optional>

#include "branches/branch.hpp"

/// Grazes on curves in two parameters.
namespace clatter::branches {

/// Of those on rigid stops.
[[nodiscard]] std::size_t slowest_impact(const Orbit& orbit);

/// The event with which the shortest contact with a soft stop, or interruption of one, begins; nothing if none is
/// short.
[[nodiscard]] std::optional<std::size_t> shortest_contact(const Orbit& orbit);

/// A graze, of motion over many periods in one of them, as that of the motion that repeats sooner. Under dry friction
/// an impact without speed is kept as a halt on the stop, with which the motion is one on either side of the graze.
void make_once(SpecialPoint& graze, bool symmetric_scenes);

}  // namespace clatter::branches
