#pragma once

#include <string>
#include <vector>

#include "answers/extremes.hpp"
#include "terminal/asked_units.hpp"

namespace clatter::app {

/// The points for people, one a line: "  0.4576 m/s at frequency = 21.25 Hz, stop = 1, periodic, LU". Lengths that are
/// all below 0.1 m are in mm, as in pictures.
[[nodiscard]] std::string extremes_text(const Extremes& extremes, const std::vector<Extreme>& points,
                                        const AskedUnits& asked);

}  // namespace clatter::app
