#pragma once

#include "orbit.hpp"

namespace verify {

/// Whether the events show that a motion doesn't repeat after a share 1/parts of them.
[[nodiscard]] bool differs_after(const std::vector<Event>& events, std::size_t parts, const Ball& total);
void check_smallest_period(const Certificate& certificate, const Scene& scene, const Orbit& orbit, Report& report);
void check_multipliers(const Certificate& certificate, const Matrix& derivative, Report& report);
/// `x`: where the motion starts.
void check_word(const Certificate& certificate, const std::vector<Event>& events, const Scene& scene, const Ball& x,
                Report& report);
/// Whether the motion is its own mirror image half a period later.
void check_symmetry(const Certificate& certificate, const Scene& scene, const Orbit& orbit, Report& report);

/// Whether a special point of the claimed kind lies within the claimed errors.
void check_special(const Certificate& certificate, Report& report);

}  // namespace verify
