#pragma once

#include <span>

#include "motion.hpp"

namespace verify {

/// The largest displacement (sign = 1), or the smallest (-1), on some stretches of a motion.
[[nodiscard]] Ball extremum(std::span<const Motion::Stretch> stretches, int sign);

}  // namespace verify
