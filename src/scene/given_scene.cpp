#include "scene/given_scene.hpp"

#include <cmath>
#include <numbers>

namespace clatter {
inline namespace scene {
namespace {

/// Whether a force or a shaking has a frequency.
bool has_frequency(const GivenScene& given) {
  const bool is_driven = given.oscillator.forcing != 0 || is_shaken(given.shaking);
  return is_driven && given.oscillator.frequency != 0;
}

/// The scene on a shaken base as the ground sees it (eq. 69).
Scene on_the_ground(Scene scene) {
  const double theta = scene.start.phase + scene.shaking.phase, nu = scene.oscillator.frequency;
  scene.start.displacement += scene.shaking.base * std::sin(theta);
  scene.start.velocity += scene.shaking.base * nu * std::cos(theta);
  const auto [amplitude, lead] = force_on_ground(scene.oscillator, scene.shaking);
  scene.oscillator.forcing = amplitude, scene.shaking.lead = lead;
  scene.start.phase += lead;
  return scene;
}

}  // namespace

Units natural_units(const GivenScene& given) {
  Units units{.mass = given.mass, .is_si = given.is_si};
  const double k = std::abs(given.oscillator.stiffness);
  if (k != 0)
    units.time = std::sqrt(given.mass / k), units.stiffness = k;
  else if (given.is_si && has_frequency(given))
    units.time = 1 / (2 * std::numbers::pi * given.oscillator.frequency);
  if (k == 0) units.stiffness = given.mass / (units.time * units.time);
  return units;
}

std::pair<Scene, Units> computed(const GivenScene& given) {
  const Units units = natural_units(given);
  Scene scene = computed(given, units);
  const bool is_unit = given.oscillator.stiffness == 0 && has_frequency(given);  // of the time, to rounding
  if (given.is_si && (is_unit || given.oscillator.frequency == 0)) scene.oscillator.frequency = 1;
  return {scene, units};
}

Scene in_shaken_frame(Scene scene) {
  if (!is_shaken(scene.shaking)) return scene;
  if (has_loose_mass(scene.loose)) return on_the_ground(scene);
  const auto [amplitude, lead] = force_in_frame(scene.oscillator, scene.shaking);
  scene.oscillator.forcing = amplitude, scene.shaking.lead = lead;
  scene.start.phase += lead;
  return scene;
}

}  // namespace scene
}  // namespace clatter
