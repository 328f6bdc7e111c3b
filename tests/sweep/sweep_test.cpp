#include "sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace clatter::sweep {
namespace {

using enum Parameter;

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

TEST(Parameter, every_key_leads_to_its_parameter_and_back) {
  constexpr std::array all{h,           f,          nu,         phase,          R,
                           xs,          stop_lower, stop_upper, R_lower,        R_upper,
                           load,        x0,         v0,         stop_amplitude, base_amplitude,
                           start_period};
  for (const Parameter parameter : all) EXPECT_EQ(parameter_of(key_of(parameter)), parameter) << key_of(parameter);
  EXPECT_EQ(parameter_of("tau"), std::nullopt);
}

TEST(Parameter, the_sign_of_xs_does_not_matter) {
  for (const double value : {-0.75, 0.75}) {
    point::Problem scene;
    set(scene, xs, value);
    EXPECT_EQ(scene.stops.lower, -0.75);
    EXPECT_EQ(scene.stops.upper, 0.75);
  }
}

TEST(Parameter, R_sets_both_restitutions_and_each_stop_can_have_its_own) {
  point::Problem scene;
  set(scene, R, 0.7);
  set(scene, R_upper, 0.3);
  EXPECT_EQ(scene.stops.restitution_lower, 0.7);
  EXPECT_EQ(scene.stops.restitution_upper, 0.3);
}

TEST(Parameter, every_other_one_has_its_own_place) {
  point::Problem scene;
  set(scene, phase, 1);
  set(scene, load, 2);
  set(scene, x0, 3);
  set(scene, v0, 4);
  set(scene, stop_lower, -5);
  set(scene, stop_upper, 6);
  EXPECT_EQ(scene.start.phase, 1);
  EXPECT_EQ(scene.oscillator.load, 2);
  EXPECT_EQ(scene.start.displacement, 3);
  EXPECT_EQ(scene.start.velocity, 4);
  EXPECT_EQ(scene.stops.lower, -5);
  EXPECT_EQ(scene.stops.upper, 6);
}

TEST(StartPeriod, starts_on_the_lower_stop_with_the_speed_of_the_motion_that_has_this_period) {
  // check 1 of the physics: T = 4 arcsin(g/V) and |x'| at contact sqrt(V^2 - g^2), so that v0 = g cot(T/4)
  const double g = 0.75, V = 1.3;
  point::Problem scene;
  set(scene, xs, -g);
  set(scene, start_period, 4 * std::asin(g / V));
  EXPECT_EQ(scene.start.displacement, -g);
  EXPECT_NEAR(scene.start.velocity, std::sqrt(V * V - g * g), 4e-16 * 8);  // a few roundings of arcsin and tan
}

TEST(StartPeriod, follows_the_stops_whether_it_is_fixed_or_swept) {
  Sweep fixed;
  fixed.dimensions = {{{xs, {-1, -2}}}};
  fixed.start_period = std::numbers::pi;
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
}  // namespace clatter::sweep
