#pragma once

#include "branches/start/start.hpp"

namespace clatter::branches {

/// Throws SettingError if the walls of a loose mass would meet over a range of a parameter, or it moves both, which
/// differ.
void require_walls_in_range(const FollowedScene& scene, Parameter parameter, const std::array<double, 2>& range);

/// The periodic motion of a loose mass near a state, as `start_orbit` gives it; `problem` is the scene as it is
/// computed. Throws StartError if the mass meets no wall or is pressed onto one, as neither is followed.
[[nodiscard]] Orbit start_in_housing(const FollowedScene& scene, const point::Problem& problem, const MotionStart& near,
                                     bool symmetric);

}  // namespace clatter::branches
