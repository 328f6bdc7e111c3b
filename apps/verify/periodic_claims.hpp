#pragma once

#include "orbit.hpp"

namespace verify {

void check_smallest_period(const Certificate& certificate, const Scene& scene, const Orbit& orbit, Report& report);
void check_multipliers(const Certificate& certificate, const Matrix& derivative, Report& report);
void check_word(const Certificate& certificate, const std::vector<Event>& events, Report& report);
/// Whether the motion is its own mirror image half a period later.
void check_symmetry(const Certificate& certificate, const Scene& scene, const Orbit& orbit, Report& report);

}  // namespace verify
