#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "sweep/sweep.hpp"

namespace clatter {

/// Calls `take(axis, value)` for each axis at a point.
void each_coordinate(const Sweep& sweep, std::size_t point, const std::function<void(const Axis&, double)>& take);

/// "nu = 0.5, xs = -3"; empty where nothing is swept.
[[nodiscard]] std::string coordinates_text(const Sweep& sweep, std::size_t point);

}  // namespace clatter
