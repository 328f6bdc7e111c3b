#include "branches/followed_scene.hpp"

#include <cmath>
#include <limits>

namespace clatter::branches {

StartProblem damped_by(const StartProblem& start, Parameter parameter) {
  const double h = start.oscillator.damping, natural = std::sqrt(std::abs(start.oscillator.stiffness));
  const double own = value_of(start, parameter);
  const bool is_own = own != 0 && std::isfinite(own);
  if (parameter.role() != Role::damping || !start.given.is_si || h == 0 || is_own) return start;
  StartProblem same = start;
  GivenScene& given = same.given;
  given.damper = given.damping_ratio = 0, given.quality = std::numeric_limits<double>::infinity();
  const bool is_ratio = parameter == "damping_ratio";
  set(given, parameter,
      is_ratio                 ? h / natural
      : parameter == "quality" ? natural / (2 * h)
                               : 2 * h * given.mass / start.units.time);
  return same;
}

FollowedScene changed(const FollowedScene& scene, Parameter parameter, double value) {
  GivenScene given = scene.given;
  set(given, parameter, value);
  return {given, scene.units};
}

SceneNumbers<Along> numbers_along(const FollowedScene& scene, Parameter parameter) {
  return numbers_of<Along>(scene, [&](auto& given) { set(given, parameter, Along(value_of(scene, parameter), 0)); });
}

bool keeps_symmetry(const FollowedScene& scene, Parameter parameter) {
  const bool moves_equilibrium = varies_stiffness(scene, parameter) && mirror_centre(scene) != 0.0;
  return parameter.keeps_symmetry() && !moves_equilibrium;
}

bool varies_stiffness(const FollowedScene& scene, Parameter parameter) {
  return !numbers_along(scene, parameter).oscillator.stiffness.is_constant();
}

Oscillator oscillator_in_frame(const Scene& scene) {
  Oscillator oscillator = scene.oscillator;
  oscillator.forcing = force_in_frame(oscillator, scene.shaking).amplitude;
  return oscillator;
}

point::Problem with_scene(const StartProblem& start, const FollowedScene& scene) { return {scene, start, scene.units}; }

std::string key_in_section(const FollowedScene& scene, Parameter parameter) {
  return (scene.given.is_si ? "machine." : "scene.") + std::string(parameter.key());
}

}  // namespace clatter::branches
