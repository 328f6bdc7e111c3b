#pragma once

#include "motion/soft_stop.hpp"

namespace clatter::motion {

/// `soft_stop_at` and `soft_stop_around` of known numbers, compiled once: for code with fewer optimisations, which
/// shares no template with the rest.
[[nodiscard]] SoftStop<double> known_soft_stop(const Stops& stops, Side side);
[[nodiscard]] Within<double> known_soft_stop_around(const Stops& stops, double x, double v);

}  // namespace clatter::motion
