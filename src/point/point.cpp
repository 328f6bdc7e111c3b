#include "point/point.hpp"

#include <chrono>
#include <utility>

#include "point/exact_points.hpp"
#include "point/general_points.hpp"

namespace clatter::point {

ThreadScratch::~ThreadScratch() = default;

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
    with_effects(items.front().effects, [&]<Effects E>() { ExactPoints<E>::run(items, scratch, take); });
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
  return with_effects(effects, []<Effects E>() { return ExactPoints<E>::seconds_per_evaluation(); });
}

}  // namespace clatter::point
