#include "observables/samples/section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "point/point.hpp"
#include "scene/displacement_bound.hpp"

namespace clatter::observables::section_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), pi_ = std::numbers::pi;

point::Problem scene_of(const Oscillator& oscillator, const Stops& stops, std::int64_t states) {
  point::Problem scene;
  scene.oscillator = oscillator, scene.stops = stops;
  scene.observe.section = states;
  return scene;
}

point::PointResult result_of(const point::Problem& scene) {
  point::ThreadScratch scratch;
  return run_point(scene, scratch);
}

/// Just past grazing in Fig. 23: chaotic, or of two periods.
point::Problem beside_figure_23(double nu, std::int64_t states) {
  return scene_of({0.1, -1.0, nu, 0.0}, {-3, 3, 0.7, 0.7}, states);
}

TEST(Section, of_the_steady_response_is_one_state_of_its_closed_form) {
  point::Problem scene = scene_of({0.1, -1.5, 0.8, 0.4}, {-infinity, infinity, 1, 1}, 5);
  for (const double phase : {0.0, 1.0, -2.0, 7.5}) {
    scene.observe.section_phase = phase;
    const point::PointResult r = result_of(scene);
    const PhasePoint response = response_at(scene.oscillator, std::sin(phase), std::cos(phase));
    ASSERT_EQ(r.section_x.size(), 1u) << phase;
    EXPECT_NEAR(r.section_x[0], 0.4 + response.x, 1e-14) << phase;
    EXPECT_NEAR(r.section_v[0], response.v, 1e-14) << phase;
  }
}

TEST(Section, of_periodic_motion_has_a_state_for_each_of_its_forcing_periods) {
  // beside them, samples of the trajectory at the same instants
  constexpr std::size_t each = 8;
  for (const double turns : {0.0, 0.125, 0.625}) {
    point::Problem scene = beside_figure_23(0.868, 100);
    scene.observe.section_phase = 2 * pi_ * turns;
    scene.observe.trajectory = 2 * each + 1;
    const point::PointResult r = result_of(scene);
    ASSERT_EQ(r.status, steady::Status::periodic);
    ASSERT_EQ(r.section_x.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto sample = static_cast<std::size_t>((static_cast<double>(i) + turns) * each);
      EXPECT_NEAR(r.section_x[i], r.x[sample], 1e-13) << turns;
      EXPECT_NEAR(r.section_v[i], r.v[sample], 1e-13) << turns;
    }
  }
}

TEST(Section, counts_forcing_phases_from_that_of_the_start) {
  point::Problem scene = beside_figure_23(0.868, 2);
  scene.start.phase = 1.0, scene.observe.section_phase = 1.0, scene.observe.trajectory = 3;
  const point::PointResult r = result_of(scene);
  ASSERT_EQ(r.section_x.size(), 2u);
  for (const std::size_t i : {0u, 1u}) EXPECT_NEAR(r.section_x[i], r.x[i], 1e-13);
}

TEST(Section, of_chaotic_motion_goes_on_beyond_the_window) {
  point::Problem scene = beside_figure_23(0.9, 50);
  scene.time.max_periods = 300, scene.time.window = 50;
  const point::PointResult within = result_of(scene);
  scene.time.window = 10;
  const point::PointResult beyond = result_of(scene);
  ASSERT_EQ(within.status, steady::Status::aperiodic);
  ASSERT_EQ(within.section_x.size(), 50u);
  EXPECT_EQ(within.section_x, beyond.section_x);
  EXPECT_EQ(within.section_v, beyond.section_v);
  EXPECT_EQ(within.periods, beyond.periods);
  EXPECT_EQ(beyond.observed_turns, 10.0);
  scene.observe.section = 0;
  EXPECT_EQ(result_of(scene).end.displacement, beyond.end.displacement);  // along `follow` nothing changes
}

TEST(Section, of_a_transient_lies_within_its_duration) {
  point::Problem scene = beside_figure_23(0.9, 100);
  scene.time.mode = steady::Mode::transient;
  for (const auto& [periods, turns, states] :
       {std::tuple{5.0, 0.0, 5u}, {5.5, 0.0, 6u}, {5.5, 0.6, 5u}, {0.5, 0.6, 0u}}) {
    scene.time.duration = periods * period_of(scene.oscillator);
    scene.observe.section_phase = 2 * pi_ * turns;
    const point::PointResult r = result_of(scene);
    ASSERT_EQ(r.section_x.size(), states) << periods << ", " << turns;
    if (turns == 0) {
      EXPECT_EQ(r.section_x[0], scene.start.displacement);
    }
  }
}

TEST(Section, of_free_motion_has_its_upward_passages_through_the_equilibrium) {
  // each turn takes off the factor e^(-2 pi h / lambda)
  const double h = 0.05, lambda = std::sqrt(1 - h * h), load = 0.3;
  point::Problem scene = scene_of({h, 0.0, 1.0, load}, {-infinity, infinity, 1, 1}, 100);
  scene.time.mode = steady::Mode::transient, scene.time.duration = 5.5 * 2 * pi_ / lambda;
  scene.start.displacement = load, scene.start.velocity = 2.0;
  const point::PointResult r = result_of(scene);
  ASSERT_EQ(r.section_v.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(r.section_v[i], 2 * std::exp(-2 * pi_ * h / lambda * static_cast<double>(i)), 1e-13) << i;
    EXPECT_NEAR(r.section_x[i], load, 1e-14) << i;
  }
}

TEST(Section, of_free_periodic_motion_between_stops_is_one_passage) {
  for (const double x : {0.0, 0.2, -0.2}) {
    point::Problem scene = scene_of({0.0, 0.0, 1.0, 0.0}, {-0.75, 0.75, 1, 1}, 10);
    scene.start.displacement = x, scene.start.velocity = 2.0;
    const point::PointResult r = result_of(scene);
    ASSERT_EQ(r.section_v.size(), 1u) << x;
    EXPECT_NEAR(r.section_v[0], std::sqrt(4 + x * x), 1e-14) << x;
  }
}

TEST(Section, a_bounce_at_the_equilibrium_is_no_passage) {
  for (const Stops& stops : {Stops{0.0, infinity, 1, 1}, Stops{-infinity, 0.0, 1, 1}}) {
    point::Problem scene = scene_of({0.0, 0.0, 1.0, 0.0}, stops, 10);
    scene.start.displacement = std::isfinite(stops.lower) ? 0.5 : -0.5;
    const point::PointResult r = result_of(scene);
    EXPECT_EQ(r.status, steady::Status::periodic);
    EXPECT_TRUE(r.section_x.empty());
  }
}

}  // namespace
}  // namespace clatter::observables::section_test
