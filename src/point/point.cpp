#include "point/point.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "point/general_points.hpp"
#include "point/point_run.hpp"
#include "stepping/exact.hpp"

namespace clatter::point {

Effects effects_of(const Problem& problem) {
  const Scene& scene = problem;
  if (problem.integration.method != stepping::Method::exact) return general_effects(scene);
  return problem.integration.all_effects ? all_effects(scene) : required_effects(problem, duration_of(problem.time));
}

void run_batch(std::span<const WorkItem> items, ThreadScratch& scratch,
               const std::function<void(const WorkItem&, PointResult&&)>& take) {
  if (items.empty()) return;
  const stepping::Method method = items.front().problem.integration.method;
  if (method == stepping::Method::dopri5) {
    for (const WorkItem& item : items) take(item, run_by_dormand_prince(item.problem, scratch));
  } else if (method == stepping::Method::moreau) {
    for (const WorkItem& item : items) take(item, run_by_moreau(item.problem, scratch));
  } else {
    with_effects(items.front().effects, [&]<Effects E>() {
      for (const WorkItem& item : items) {
        const stepping::Exact<double, E> integrator(item.problem, stops_in_reach(item.problem.stops, item.effects),
                                                    limits_of(item.problem));
        take(item, Point(item.problem, scratch, integrator).run());
      }
    });
  }
}

PointResult run_point(const Problem& problem, ThreadScratch& scratch) {
  PointResult result;
  const WorkItem item{0, 0, problem, effects_of(problem)};
  run_batch({&item, 1}, scratch, [&](const WorkItem&, PointResult&& of_point) { result = std::move(of_point); });
  return result;
}

double seconds_per_period(Problem problem, ThreadScratch& scratch) {
  constexpr double enough = 5e-3;  // seconds
  problem.time.mode = steady::Mode::transient;
  problem.observe = {};
  for (double periods = 1e-6;; periods *= 10) {
    problem.time.duration = periods * period_of(problem.oscillator);
    const auto begin = std::chrono::steady_clock::now();
    (void)run_point(problem, scratch);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds > enough || periods > 5) return seconds / periods;
  }
}

double seconds_per_evaluation(const Effects& effects) {
  return with_effects(effects, []<Effects E>() {
    Problem problem;
    problem.oscillator.damping = E.damping == Damping::none ? 0.0 : E.damping == Damping::light ? 0.04 : 2.0;
    problem.oscillator.forcing = E.forcing == Forcing::none ? 0.0 : 1.0;
    problem.oscillator.frequency = E.forcing == Forcing::secular ? 1.03 : 1.3;
    if (E.stiffness) problem.oscillator.stiffness = E.damping == Damping::light ? 1.1 : 0.0;
    problem.start.velocity = 1.0;
    if (E.stops()) problem.stops = {-0.5, 0.5, 0.7, 0.7};
    if (E.soft) problem.stops.stiffness_lower = problem.stops.stiffness_upper = 100.0;
    using Clock = std::chrono::steady_clock;
    double least = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < 3; ++repetition) {
      stepping::Exact<double, E> integrator(problem);
      motion::State<double> state;
      state.v = problem.start.velocity;
      stepping::NoObserver nobody;
      const auto begin = Clock::now();
      (void)run_for(integrator, state, 50.0, nobody);
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      least = std::min(least, seconds / std::max(1.0, integrator.evaluations()));
    }
    return least;
  });
}

}  // namespace clatter::point
