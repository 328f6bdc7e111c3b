#include "sweep/point.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "integrators/exact.hpp"
#include "sweep/general_points.hpp"
#include "sweep/point_run.hpp"

namespace clatter {

Effects effects_of(const Scene& scene) {
  const double h = scene.oscillator.damping;
  if (scene.integration.method != Method::exact) return general_effects(h);
  return scene.integration.all_effects ? all_effects(h) : required_effects(scene);
}

void run_batch(std::span<const Task> tasks, Workshop& workshop,
               const std::function<void(const Task&, PointResult&&)>& take) {
  if (tasks.empty()) return;
  const Method method = tasks.front().scene.integration.method;
  if (method == Method::dopri5) {
    for (const Task& task : tasks) take(task, run_by_dormand_prince(task.scene, workshop));
  } else if (method == Method::moreau) {
    for (const Task& task : tasks) take(task, run_by_moreau(task.scene, workshop));
  } else {
    with_effects(tasks.front().effects, [&]<Effects kernel>() {
      for (const Task& task : tasks) {
        const Exact<double, kernel> integrator(task.scene, stops_in_reach(task.scene.stops, task.effects));
        take(task, Point(task.scene, workshop, integrator).run());
      }
    });
  }
}

PointResult run_point(const Scene& scene, Workshop& workshop) {
  PointResult result;
  const Task task{0, scene, effects_of(scene)};
  run_batch({&task, 1}, workshop, [&](const Task&, PointResult&& of_point) { result = std::move(of_point); });
  return result;
}

double seconds_per_period(Scene scene, Workshop& workshop) {
  constexpr double enough = 5e-3;  // seconds
  scene.time.mode = Mode::transient;
  scene.observe = {};
  for (double periods = 1e-6;; periods *= 10) {
    scene.time.duration = periods * period_of(scene.oscillator);
    const auto begin = std::chrono::steady_clock::now();
    (void)run_point(scene, workshop);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds > enough || periods > 5) return seconds / periods;
  }
}

double seconds_per_evaluation(const Effects& effects) {
  return with_effects(effects, []<Effects kernel>() {
    Scene scene;
    scene.oscillator.damping = kernel.damping == Damping::none ? 0.0 : kernel.damping == Damping::light ? 0.04 : 2.0;
    scene.oscillator.forcing = kernel.forcing == Forcing::none ? 0.0 : 1.0;
    scene.oscillator.frequency = kernel.forcing == Forcing::secular ? 1.03 : 1.3;
    scene.start.velocity = 1.0;
    if (kernel.stops()) scene.stops = {-0.5, 0.5, 0.7, 0.7};
    using Clock = std::chrono::steady_clock;
    double least = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < 3; ++repetition) {
      Exact<double, kernel> integrator(scene);
      State<double> state;
      state.v = scene.start.velocity;
      NoObserver nobody;
      const auto begin = Clock::now();
      (void)run_for(integrator, state, 50.0, nobody);
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      least = std::min(least, seconds / std::max(1.0, integrator.evaluations()));
    }
    return least;
  });
}

}  // namespace clatter
