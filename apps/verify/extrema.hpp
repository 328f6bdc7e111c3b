#pragma once

#include <span>

#include "event.hpp"

namespace verify {

/// The largest displacement (sign = 1), or the smallest (-1), on some stretches of a motion and in other places.
[[nodiscard]] Ball extremum(std::span<const Stretch> stretches, std::span<const Ball> places, int sign);

}  // namespace verify
