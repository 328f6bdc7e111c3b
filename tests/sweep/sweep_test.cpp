#include "sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace clatter::sweep::sweep_test {
namespace {

constexpr Parameter nu = "nu", f = "f", xs = "xs", start_period = "start_period";

TEST(Sweep, without_axes_is_one_point_the_scene_itself) {
  Sweep sweep;
  sweep.problem.oscillator.damping = 0.1;
  EXPECT_EQ(size(sweep), 1u);
  EXPECT_EQ(problem_at(sweep, 0).oscillator.damping, 0.1);
}

TEST(Sweep, the_first_dimension_varies_slowest) {
  Sweep sweep;
  sweep.dimensions = {{{nu, {1, 2}}}, {{xs, {3, 4, 5}}}};
  ASSERT_EQ(size(sweep), 6u);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const point::Problem scene = problem_at(sweep, 3 * i + j);
      EXPECT_EQ(scene.oscillator.frequency, 1.0 + static_cast<double>(i));
      EXPECT_EQ(scene.stops.upper, 3.0 + static_cast<double>(j));
    }
  }
}

TEST(Sweep, linked_axes_run_together) {
  Sweep sweep;
  sweep.dimensions = {{{nu, {1, 2, 3}}, {f, {10, 20, 30}}}};
  ASSERT_EQ(size(sweep), 3u);
  EXPECT_EQ(problem_at(sweep, 1).oscillator.frequency, 2);
  EXPECT_EQ(problem_at(sweep, 1).oscillator.forcing, 20);
}

TEST(Sweep, points_count_as_an_odometer_does_and_begin_anew_on_the_way_back) {
  Sweep sweep;
  sweep.dimensions = {{{nu, {1, 2}}}, {{f, {10, 20, 30}}}, {{xs, {100}}}, {{"R", {0.1, 0.2, 0.3, 0.4, 0.5}}}};
  sweep.follow = 1, sweep.direction = Direction::both;
  std::size_t point = 0;
  for (int way = 0; way < 2; ++way)
    for (const double nu_value : {1, 2})
      for (const double f_value : {10, 20, 30})
        for (const double R_value : {0.1, 0.2, 0.3, 0.4, 0.5}) {
          const point::Problem scene = problem_at(sweep, point++);
          EXPECT_EQ(scene.oscillator.frequency, nu_value);
          EXPECT_EQ(scene.oscillator.forcing, f_value);
          EXPECT_EQ(scene.stops.lower, -100);
          EXPECT_EQ(scene.stops.restitution_upper, R_value);
        }
  EXPECT_EQ(point, size(sweep));
}

TEST(StartPeriod, follows_the_stops_whether_it_is_fixed_or_swept) {
  Sweep fixed;
  fixed.dimensions = {{{xs, {-1, -2}}}};
  fixed.problem.start_period = std::numbers::pi;
  Sweep swept;
  swept.dimensions = {{{start_period, {std::numbers::pi}}},
                      {{xs, {-1, -2}}}};  // before xs in the text, after it in the scene
  for (const Sweep& sweep : {fixed, swept}) {
    const point::Problem scene = problem_at(sweep, 1);
    EXPECT_EQ(scene.start.displacement, -2);
    EXPECT_NEAR(scene.start.velocity, 2.0, 1e-15);  // cot(pi/4) = 1
  }
}

}  // namespace
}  // namespace clatter::sweep::sweep_test
