#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "math/number.hpp"
#include "motion/walls.hpp"
#include "point/point.hpp"
#include "point/point_run.hpp"
#include "scene/required_effects.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::support {

/// A main mass from rest that carries a loose one between walls at -gap and +gap.
[[nodiscard]] inline point::Problem loose_scene(double eps, double h, double f, double nu, double gap, double R) {
  point::Problem scene;
  scene.oscillator = {.damping = h, .forcing = f, .frequency = nu};
  scene.loose = {.ratio = eps, .lower = -gap, .upper = gap, .restitution = R};
  return scene;
}

/// Records the impacts of a loose mass, and the times in which a wall presses it.
struct LooseRecorder {
  std::vector<motion::Strike> strikes{};
  std::vector<motion::Press> presses{};
  std::vector<motion::Rest> holds{};

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact&) {}
  void strike(const motion::Strike& strike) { strikes.push_back(strike); }
  void press(const motion::Press& press) { presses.push_back(press); }
  template <class A>
  void hold(const A&, const motion::Rest& hold) {
    holds.push_back(hold);
  }
};

/// A run from the start of a scene for a time in tau.
struct LooseRun {
  LooseRecorder record{};
  motion::State<double> end{};
  double z = 0.0, w = 0.0;  ///< at the end
  stepping::Outcome outcome = stepping::Outcome::unresolved;
};
[[nodiscard]] inline LooseRun run_loose(const point::Problem& scene, double duration) {
  const auto by = [&]<Effects E>() {
    stepping::Exact<double, E> exact(scene, stepping::Limits{.impacts = 1e9});
    LooseRun run{.end = point::start_of(scene)};
    run.outcome = run_for(exact, run.end, duration / exact.period(), run.record);
    const auto [z, w] = motion::place_in_housing(run.end, scene.loose);
    run.z = z, run.w = w;
    return run;
  };
  if (rotates(scene.oscillator))
    return by.template operator()<effect_sets::with_loose_mass(Damping::light, Forcing::secular)>();
  return by.template operator()<effect_sets::with_loose_mass(Damping::heavy, Forcing::regular)>();
}

/// The steady motion of a scene, with all that is observed of a loose mass.
[[nodiscard]] inline point::PointResult observed(point::Problem scene) {
  scene.observe.extrema = scene.observe.impacts = scene.observe.impact_log = scene.observe.stability = true;
  scene.observe.word = scene.observe.period = scene.observe.energy = true;
  point::ThreadScratch scratch;
  return run_point(scene, scratch);
}

}  // namespace clatter::support
