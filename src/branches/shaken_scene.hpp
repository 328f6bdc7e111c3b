#pragma once

#include "point/problem.hpp"
#include "sweep/parameter.hpp"

namespace clatter::branches {

/// A scene as its user gives it, with what shakes its stops or its base. Phases are those of the shaking, nu tau +
/// phase; without any that is the phase of the force.
struct ShakenScene : Scene {
  Shaking shaking{};
  double inverse_mass = 1.0;  ///< over that at the start; forces, dampers and springs are per unit mass

  ShakenScene() = default;
  ShakenScene(const Scene& scene) : Scene(scene) {}
  ShakenScene(const point::Problem& problem) : Scene(problem), shaking(problem.shaking) {}
};

/// A scene with one of its parameters changed; `mass` is its inverse, over that at the start; `xs`, `R`,
/// `stop_stiffness` and `stop_damping` change both stops.
[[nodiscard]] ShakenScene changed(ShakenScene scene, sweep::Parameter parameter, double value);
[[nodiscard]] double value_of(const ShakenScene& scene, sweep::Parameter parameter);

/// Whether a symmetric scene stays so if a parameter changes.
[[nodiscard]] bool keeps_symmetry(const Scene& scene, sweep::Parameter parameter);

/// Whether the stiffness of the spring, per unit mass, changes with a parameter.
[[nodiscard]] constexpr bool varies_stiffness(sweep::Parameter parameter) {
  return parameter == sweep::Parameter::stiffness || parameter == sweep::Parameter::mass;
}

/// Its oscillator in the frame of what is shaken, with the force there (eqs. 39 and 40).
[[nodiscard]] inline Oscillator oscillator_in_frame(const ShakenScene& scene) {
  Oscillator oscillator = scene.oscillator;
  oscillator.forcing = force_in_frame(oscillator, scene.shaking).amplitude;
  return oscillator;
}

/// A problem with another scene, as its user would give it.
[[nodiscard]] inline point::Problem with_scene(point::Problem problem, const ShakenScene& scene) {
  static_cast<Scene&>(problem) = scene, problem.shaking = scene.shaking;
  return problem;
}

}  // namespace clatter::branches
