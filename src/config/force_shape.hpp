#pragma once

#include <string_view>

#include "config/consistency.hpp"
#include "scene/given_scene.hpp"
#include "scene/parameter.hpp"

namespace clatter::config {

/// The waveform of the force that the settings choose.
[[nodiscard]] Waveform waveform_of(const Settings& settings);
/// Whether that is no sum of sines: a force in pieces with knots between them.
[[nodiscard]] bool has_force_in_pieces(const Settings& settings);

/// Whether a parameter is the amplitude of an order of the force.
[[nodiscard]] constexpr bool is_order_amplitude(Parameter parameter) {
  return parameter.role() == Role::force_order && !parameter.key().starts_with("phase");
}
/// The amplitude of the order of the force that a parameter belongs to.
[[nodiscard]] Parameter amplitude_of_order(Parameter order, bool is_si);

/// The key that makes the force another one than a sine.
[[nodiscard]] std::string_view key_of_shape(const Settings& settings);

/// Gives a scene the shape of its force.
void set_force_shape(const Settings& settings, GivenScene& scene);

/// Throws ConfigError if a force that is no sine stands beside what goes with a sine only.
void check_force_shape(const Settings& settings);

}  // namespace clatter::config
