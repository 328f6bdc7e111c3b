#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "sweep/sweep.hpp"

namespace clatter::app {

/// Calls `take(axis, value)` for each axis at a point.
void each_coordinate(const sweep::Sweep& sweep, std::size_t point,
                     const std::function<void(const sweep::Axis&, double)>& take);

/// "nu = 0.5, xs = -3"; empty if nothing is swept.
[[nodiscard]] std::string coordinates_text(const sweep::Sweep& sweep, std::size_t point);

}  // namespace clatter::app
