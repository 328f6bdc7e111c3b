// The cost of a point: memory only for what is kept, arcs evaluated only for what is observed.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <vector>

#include "point/point.hpp"
#include "sweep/figures.hpp"

namespace {
std::atomic<long> allocated{0};  ///< calls of operator new in this program
}

void* operator new(std::size_t size) {
  ++allocated;
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocated;
  return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

namespace clatter::sweep {
namespace {

using observables::Extrema, observables::Harmonics, observables::ImpactLog, observables::Impacts, observables::Period,
    observables::Stability, observables::Trajectory;

/// A point, what it allocated, and what it was evaluated for beyond a point of which nothing is observed.
struct Cost {
  point::PointResult result;
  long allocations = 0;
  double evaluations = 0.0;
};

Cost cost_of(const point::Problem& scene, point::ThreadScratch& scratch) {
  point::Problem silent = scene;
  silent.observe = {};
  Cost cost;
  const double nothing = run_point(silent, scratch).evaluations;
  const long before = allocated;
  cost.result = run_point(scene, scratch);
  cost.allocations = allocated - before;
  cost.evaluations = cost.result.evaluations - nothing;
  return cost;
}

Cost cost_of(const point::Problem& scene) {
  point::ThreadScratch none;
  return cost_of(scene, none);
}

/// The symmetric motion of example 4: two impacts a period, so three arcs from section to section.
point::Problem symmetric() { return paper_scene(0.5, 1.0); }
constexpr double arcs = 3, impacts = 2;

template <class... Settings>
observables::Observe observe_of(const Settings&... settings) {
  observables::Observe observe;
  ((static_cast<Settings&>(observe) = settings), ...);
  return observe;
}
template <class... Settings>
point::Problem observing(point::Problem scene, const Settings&... settings) {
  scene.observe = observe_of(settings...);
  return scene;
}

TEST(Cost, extrema_allocate_nothing_in_any_number_of_periods) {
  const Extrema::Settings extrema{.extrema = true};
  for (const std::int64_t periods : {50, 500, 5000}) {
    point::Problem chaos = observing(paper_scene(3.0, 0.95), extrema);
    chaos.time.max_periods = periods, chaos.time.window = periods;
    const Cost cost = cost_of(chaos);
    EXPECT_EQ(cost.result.status, steady::Status::aperiodic);
    EXPECT_GT(cost.result.impacts, static_cast<double>(periods));
    EXPECT_EQ(cost.allocations, 0);
  }
  point::Problem rests = observing(paper_scene(0.5, 0.5), extrema), free = rests;
  rests.stops.restitution_lower = rests.stops.restitution_upper = 0.0;
  free.oscillator = {0.0, 0.0, 1.0, 0.0}, free.start.velocity = 1.0;
  for (const point::Problem& scene :
       {observing(symmetric(), extrema), observing(paper_scene(6, 1), extrema), rests, free}) {
    const Cost cost = cost_of(scene);
    EXPECT_EQ(cost.result.status, steady::Status::periodic);
    EXPECT_LT(cost.result.x_min, cost.result.x_max);
    EXPECT_EQ(cost.allocations, 0);
    point::Problem all = scene;
    all.integration.all_effects = true;
    EXPECT_EQ(cost_of(all).allocations, 0);
  }
}

TEST(Cost, numbers_of_a_period_allocate_nothing) {
  const observables::Observe numbers =
      observe_of(Extrema::Settings{.extrema = true}, Impacts::Settings{.impacts = true},
                 Period::Settings{.period = true}, Stability::Settings{.stability = true});
  EXPECT_EQ(cost_of(observing(symmetric(), numbers)).allocations, 0);
}

TEST(Cost, kept_results_are_allocated_once) {
  // a log grows by doubling: two impacts, two steps; a trajectory is x, x' and the times
  EXPECT_EQ(cost_of(observing(symmetric(), ImpactLog::Settings{.impact_log = true})).allocations, 2);
  EXPECT_EQ(cost_of(observing(symmetric(), Trajectory::Settings{.trajectory = 1000})).allocations, 3);
  EXPECT_GT(
      cost_of(observing(symmetric(),
                        Harmonics::Settings{.harmonics = 5, .harmonics_method = observables::HarmonicsMethod::exact}))
          .allocations,
      0);
}

TEST(Cost, impacts_and_period_are_seen_without_an_evaluation) {
  for (const point::Problem& scene : {observing(symmetric(), Impacts::Settings{.impacts = true}),
                                      observing(symmetric(), ImpactLog::Settings{.impact_log = true}),
                                      observing(symmetric(), Period::Settings{.period = true})})
    EXPECT_EQ(cost_of(scene).evaluations, 0);
  EXPECT_EQ(cost_of(observing(symmetric(), ImpactLog::Settings{.impact_log = true})).result.log.size(), impacts);
}

TEST(Cost, stability_and_exact_harmonics_look_once_at_an_arc) {
  EXPECT_EQ(cost_of(observing(symmetric(), Stability::Settings{.stability = true})).evaluations, arcs);
  // the harmonic at the resonance, k = 1 with |1 - w^2 + 2ihw| = 0.2, is far enough from it for the closed form
  point::Problem away = symmetric();
  away.observe = {};
  away.observe.harmonics = 20;
  away.observe.harmonics_method = observables::HarmonicsMethod::exact;
  EXPECT_EQ(cost_of(away).evaluations, arcs);
  // with h = 0.05 it is within 1/8: panels of 20 points, each of 4 radians of nu + 1 = 2 over a period of 2 pi
  away.oscillator.damping = 0.05;
  const Cost near = cost_of(away);
  EXPECT_GE(near.evaluations, near.result.impacts > 0 ? arcs + 20 * 4 : 0);
  EXPECT_LE(near.evaluations, arcs + 20 * (4 + arcs));
}

TEST(Cost, samples_are_evaluated_once_each_and_not_on_impacts) {
  for (const std::int64_t count : {2, 100, 5000}) {
    const Cost cost = cost_of(observing(symmetric(), Trajectory::Settings{.trajectory = count}));
    EXPECT_EQ(cost.evaluations, static_cast<double>(count - 1));  // the last is the end of the run
    EXPECT_EQ(cost.result.x.size(), static_cast<std::size_t>(count));
  }
  point::ThreadScratch scratch{Harmonics::scratch_for(Harmonics::Settings{.harmonics = 5})};
  const Cost cost = cost_of(observing(symmetric(), Harmonics::Settings{.harmonics = 5}), scratch);
  EXPECT_EQ(cost.evaluations, 4096);
  EXPECT_EQ(cost.result.x_spectrum.amplitude.size(), 6u);
}

TEST(Cost, extrema_look_at_an_arc_a_few_times) {
  // the end of each arc, and for displacement and velocity one or two turning points by a few steps of Newton's method
  const Cost cost = cost_of(observing(symmetric(), Extrema::Settings{.extrema = true}));
  EXPECT_GE(cost.evaluations, arcs);
  EXPECT_LE(cost.evaluations, arcs * (1 + 2 * 2 * 8));
}

TEST(Cost, is_the_sum_over_the_observables) {
  point::ThreadScratch scratch{Harmonics::scratch_for(Harmonics::Settings{.harmonics = 5})};
  const observables::Observe each[] = {
      observe_of(Extrema::Settings{.extrema = true}),     observe_of(Harmonics::Settings{.harmonics = 5}),
      observe_of(Impacts::Settings{.impacts = true}),     observe_of(ImpactLog::Settings{.impact_log = true}),
      observe_of(Trajectory::Settings{.trajectory = 77}), observe_of(Period::Settings{.period = true}),
      observe_of(Stability::Settings{.stability = true})};
  const observables::Observe all = observe_of(
      Extrema::Settings{.extrema = true}, Harmonics::Settings{.harmonics = 5}, Impacts::Settings{.impacts = true},
      ImpactLog::Settings{.impact_log = true}, Trajectory::Settings{.trajectory = 77}, Period::Settings{.period = true},
      Stability::Settings{.stability = true});
  for (const point::Problem& scene : {symmetric(), paper_scene(6, 1), paper_scene(4, 1)}) {
    double sum = 0, flown = -1;
    for (const observables::Observe& observe : each) {
      const double cost = cost_of(observing(scene, observe), scratch).evaluations;
      sum += cost, flown += cost > 0 ? 1 : 0;
    }
    const bool response = scene.stops.upper == 6;  // flown once for all who have to see it, by its only arc
    EXPECT_EQ(cost_of(observing(scene, all), scratch).evaluations, sum - (response ? flown : 0));
  }
}

TEST(Cost, of_a_response_that_meets_no_stop_is_nothing_but_for_those_who_need_its_course) {
  const observables::Observe free =
      observe_of(Extrema::Settings{.extrema = true},
                 Harmonics::Settings{.harmonics = 5, .harmonics_method = observables::HarmonicsMethod::exact},
                 Impacts::Settings{.impacts = true}, Period::Settings{.period = true});
  point::Problem scene = paper_scene(6, 1.1);
  scene.oscillator.load = 0.3, scene.start.phase = 0.7;
  const point::PointResult result = cost_of(observing(scene, free)).result;
  EXPECT_EQ(result.found_by, steady::FoundBy::closed_form);
  EXPECT_EQ(result.evaluations, 0);
  scene.integration.shortcuts = false;  // flies
  const point::PointResult flown = cost_of(observing(scene, free)).result;
  EXPECT_GT(flown.evaluations, 0);
  for (const auto value :
       {&point::PointResult::x_min, &point::PointResult::x_max, &point::PointResult::v_min, &point::PointResult::v_max})
    EXPECT_NEAR(result.*value, flown.*value, 1e-11);  // what it calls a repeat
  for (const auto spectrum : {&point::PointResult::x_spectrum, &point::PointResult::v_spectrum})
    for (std::size_t k = 0; k <= 5; ++k) {
      EXPECT_NEAR((result.*spectrum).amplitude[k], (flown.*spectrum).amplitude[k], 1e-11) << k;
      if (k == 1) {
        EXPECT_NEAR((result.*spectrum).phase[k], (flown.*spectrum).phase[k], 1e-11);
      }
    }
  EXPECT_EQ(result.period, flown.period);
  EXPECT_EQ(result.impacts_per_period[0] + result.impacts_per_period[1], 0);
}

TEST(Cost, nothing_is_kept_that_is_not_asked_for) {
  const point::PointResult result = cost_of(observing(symmetric(), Extrema::Settings{.extrema = true})).result;
  EXPECT_TRUE(result.log.empty() && result.tau.empty() && result.x.empty() && result.v.empty());
  EXPECT_TRUE(result.x_spectrum.amplitude.empty() && result.v_spectrum.amplitude.empty());
  for (const double value : {result.impacts_per_period[0], result.period, result.lyapunov, result.multiplier_re[0]})
    EXPECT_TRUE(std::isnan(value));
}

TEST(Cost, motion_out_of_reach_of_its_stops_is_one_arc) {
  // Fig. 20: in closed form nothing is run to find the steady motion, and one arc is a period of it
  const Cost cost = cost_of(observing(paper_scene(6, 1), Stability::Settings{.stability = true}));
  EXPECT_EQ(cost.result.found_by, steady::FoundBy::closed_form);
  EXPECT_EQ(cost.result.periods, 1);
  EXPECT_EQ(cost.result.evaluations, 1 + 1);  // the arc's end, and its derivative
  point::Problem silent = paper_scene(6, 1);
  silent.integration.all_effects = true;
  EXPECT_GT(cost_of(silent).result.evaluations, 1000);
}

TEST(Cost, a_point_of_a_sweep_out_of_reach_of_its_stops_allocates_nothing) {
  const auto allocations = [](std::size_t points) {
    std::vector<double> frequencies(points);
    for (std::size_t i = 0; i < points; ++i) frequencies[i] = 0.5 + static_cast<double>(i) / 1e4;
    const Sweep sweep =
        sweep_of(observing(paper_scene(60, 1), Extrema::Settings{.extrema = true}), {{"nu", frequencies}});
    SweepRun sweep_run(sweep);
    const long before = allocated;
    sweep_run.run({.threads = 1});
    return allocated - before;
  };
  const long few = allocations(1000), more = allocations(3000);
  EXPECT_LT(more - few, 2000 / 10);  // nothing but for whole batches of points
}

TEST(Cost, conservative_motion_is_run_for_its_one_period) {
  point::Problem scene;
  scene.stops = {-0.749, 0.749, 1.0, 1.0}, scene.start.velocity = -1.5;
  scene.observe.stability = true;
  const Cost cost = cost_of(scene);
  EXPECT_EQ(cost.result.found_by, steady::FoundBy::energy);
  EXPECT_EQ(cost.result.impacts, 2);
  EXPECT_EQ(cost.evaluations, arcs);
  EXPECT_LE(cost.result.evaluations, arcs * 20);
}

}  // namespace
}  // namespace clatter::sweep
