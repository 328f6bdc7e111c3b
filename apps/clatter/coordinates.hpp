#pragma once

#include <cstddef>
#include <string>

#include "sweep/sweep.hpp"

namespace clatter::app {

/// "nu = 0.5, xs = -3"; empty if nothing is swept.
[[nodiscard]] std::string coordinates_text(const sweep::Sweep& sweep, std::size_t point);

}  // namespace clatter::app
