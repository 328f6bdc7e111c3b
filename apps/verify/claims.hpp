#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "cycle.hpp"
#include "orbit.hpp"

namespace verify {

/// Whether a part of the claimed periods is one; `repeats_after` tells it of a number of parts, if events leave it
/// open.
void check_smallest_period(const Certificate& certificate, const Cycle& cycle,
                           const std::function<bool(long parts)>& repeats_after, Report& report);
/// Motion that a stop lets go is known from the scene alone: it goes on as from the last time. Throws Refuted if one
/// does so twice.
void require_smallest_period_of_rests(long periods, const Cycle& cycle);
/// Compares the claimed multipliers with the eigenvalues of the derivative of a period, if these can be told.
void check_multipliers(const Certificate& certificate, const std::optional<std::vector<Vector>>& found, Report& report);
/// `x`: where the motion starts.
void check_word(const Certificate& certificate, const Cycle& cycle, const Scene& scene, const Ball& x, Report& report);
/// Whether the motion is its own mirror image half a period later; `returns_mirrored` tells it of a centre, if events
/// leave it open.
void check_symmetry(const Certificate& certificate, const Scene& scene, const Cycle& cycle,
                    const std::function<bool(const Ball& centre)>& returns_mirrored, Report& report);
/// Both claims of a proved motion.
void check_smallest_period(const Certificate& certificate, const Scene& scene, const Orbit& orbit, const Cycle& cycle,
                           Report& report);
void check_symmetry(const Certificate& certificate, const Scene& scene, const Orbit& orbit, const Cycle& cycle,
                    Report& report);

/// Whether a special point of the claimed kind lies within the claimed errors.
void check_special(const Certificate& certificate, Report& report);

}  // namespace verify
