#pragma once

#include "config/consistency.hpp"
#include "scene/given_scene.hpp"

namespace clatter::config {

/// The waveform of the force that the settings choose.
[[nodiscard]] Waveform waveform_of(const Settings& settings);

/// Gives a scene the shape of its force.
void set_force_shape(const Settings& settings, GivenScene& scene);

/// Throws ConfigError if a force that is no sine stands beside what goes with a sine only.
void check_force_shape(const Settings& settings);

}  // namespace clatter::config
