#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "point/exact_points.hpp"
#include "point/point_run.hpp"

namespace clatter::point {

template <Effects E>
class ExactMotionWith final : public ExactMotion {
 public:
  ExactMotionWith(const Problem& problem, const Stops& in_reach)
      : problem_(problem), exact_(problem_, in_reach, limits_of(problem)) {}

  [[nodiscard]] motion::State<double> start() const override { return start_of(problem_); }
  [[nodiscard]] const Stops& stops() const override { return exact_.stops(); }
  [[nodiscard]] double period() const override { return exact_.period(); }
  [[nodiscard]] double impacts() const override { return exact_.impacts(); }
  [[nodiscard]] double evaluations() const override { return exact_.evaluations(); }

  steady::ObservedTime find_steady() override {
    return steady::find_steady(exact_, start(), problem_, problem_.time, problem_.integration);
  }
  stepping::Outcome advance_to_section(motion::State<double>& state, std::int64_t origin,
                                       MotionRecorder& recorder) override {
    return stepping::advance_to_section(exact_, state, origin, recorder);
  }
  stepping::Outcome run_for(motion::State<double>& state, double turns, MotionRecorder& recorder) override {
    return stepping::run_for(exact_, state, turns, recorder);
  }

  stepping::Outcome begin_cycle(motion::State<double>& state) override {
    ends_.emplace(exact_, problem_, steady::uncertainty_of(problem_, state, problem_.time.tolerance));
    return ends_->begin(state);
  }
  stepping::Outcome end_cycle(motion::State<double>& state, std::int64_t origin, MotionRecorder& recorder) override {
    return ends_->end(state, origin, recorder);
  }

 private:
  Problem problem_;
  stepping::Exact<double, E> exact_;
  std::optional<steady::CycleEnds<stepping::Exact<double, E>>> ends_{};
};

template <Effects E>
std::unique_ptr<ExactMotion> ExactPoints<E>::motion(const Problem& problem, const Stops& in_reach) {
  return std::make_unique<ExactMotionWith<E>>(problem, in_reach);
}

template <Effects E>
void ExactPoints<E>::run(std::span<const WorkItem> items, ThreadScratch& scratch,
                         const std::function<void(const WorkItem&, PointResult&&)>& take) {
  for (const WorkItem& item : items) {
    Integrator integrator(item.problem, stops_in_reach(item.problem.stops, item.effects), limits_of(item.problem));
    take(item, Point(item.problem, scratch, integrator).run());
  }
}

template <Effects E>
PointResult ExactPoints<E>::observe(const Problem& problem, ThreadScratch& scratch, const Integrator& integrator,
                                    const steady::ObservedTime& observed) {
  Integrator further = integrator;
  return Point(problem, scratch, further).observe(observed);
}

template <Effects E>
double ExactPoints<E>::seconds_per_evaluation() {
  Problem problem;
  problem.oscillator.damping = E.damping == Damping::none ? 0.0 : E.damping == Damping::light ? 0.04 : 2.0;
  problem.oscillator.forcing = E.forcing == Forcing::none ? 0.0 : 1.0;
  problem.oscillator.frequency = E.forcing == Forcing::secular ? 1.03 : 1.3;
  if (E.stiffness) problem.oscillator.stiffness = E.damping == Damping::light ? 1.1 : 0.0;
  problem.start.velocity = 1.0;
  if (E.stops()) problem.stops = {-0.5, 0.5, 0.7, 0.7};
  if (E.soft) problem.stops.stiffness_lower = problem.stops.stiffness_upper = 100.0;
  if (E.friction) problem.friction = {0.1, 0.1};
  if (E.loose)
    problem.loose = {.ratio = 0.05,
                     .lower = -0.5,
                     .upper = 0.5,
                     .restitution_lower = 0.7,
                     .restitution_upper = 0.6,
                     .velocity = 0.3};
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 3; ++repetition) {
    stepping::Exact<double, E> integrator(problem);
    motion::State<double> state = start_of(problem);
    auto watch = steady::passage_observer(integrator, problem);
    const auto begin = Clock::now();
    (void)run_for(integrator, state, 50.0, watch);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    least = std::min(least, seconds / std::max(1.0, integrator.evaluations()));
  }
  return least;
}

}  // namespace clatter::point
