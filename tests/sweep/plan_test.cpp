#include "sweep/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sweep/figures.hpp"
#include "sweep/memory_limits.hpp"

namespace clatter {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point of Figs. 20-23, its extrema observed.
Scene figure(double xs) {
  Scene scene = paper_scene(xs, 1.0);
  scene.observe.extrema = true;
  return scene;
}

std::vector<double> frequencies() {
  std::vector<double> nu;
  for (int i = 0; i <= 100; ++i) nu.push_back(0.5 + 0.01 * i);
  return nu;
}

bool warns(const Plan& plan, const std::string& words) {
  return std::ranges::any_of(plan.warnings, [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

TEST(Plan, groups_are_the_same_for_every_number_of_threads) {
  const Sweep sweep = sweep_of(figure(3), {{Parameter::nu, frequencies()}, {Parameter::h, {0.0, 0.05, 0.1, 1.0, 2.0}}});
  const Plan one = plan_of(sweep, 1);
  EXPECT_GT(one.groups.size(), 6u);
  for (const int threads : {2, 3, 7}) {
    const Plan other = plan_of(sweep, threads);
    EXPECT_EQ(other.warnings, one.warnings);
    ASSERT_EQ(other.groups.size(), one.groups.size());
    for (std::size_t i = 0; i < one.groups.size(); ++i) {
      EXPECT_EQ(other.groups[i].effects, one.groups[i].effects);
      EXPECT_EQ(other.groups[i].points, one.groups[i].points);
      EXPECT_EQ(other.groups[i].example, one.groups[i].example);
    }
  }
}

TEST(Plan, points_run_with_the_effects_of_their_group_and_no_longer_than_it_says) {
  Scene scene = figure(3);
  scene.time.max_periods = 300;
  for (const bool all : {false, true}) {
    scene.integration.all_effects = all;
    const Sweep sweep = sweep_of(scene, {{Parameter::nu, frequencies()}});
    const Plan plan = plan_of(sweep, 2);
    const RunResult result = run(sweep, {.threads = 2});
    ASSERT_EQ(result.usage.size(), plan.groups.size());
    for (std::size_t i = 0; i < plan.groups.size(); ++i) {
      EXPECT_EQ(result.usage[i].effects, plan.groups[i].effects);
      EXPECT_EQ(result.usage[i].points, plan.groups[i].points);
      EXPECT_GE(result.usage[i].periods, plan.groups[i].periods.least);
      EXPECT_LE(result.usage[i].periods, plan.groups[i].periods.most);
      EXPECT_GT(plan.groups[i].seconds.least, 0);
      EXPECT_GE(plan.groups[i].seconds.most, plan.groups[i].seconds.least);
    }
  }
}

TEST(Plan, the_least_work_of_transients_and_of_conservative_motion_is_the_most) {
  Scene scene = figure(3);
  scene.time.mode = Mode::transient, scene.time.duration = 7.0;
  EXPECT_EQ(plan_of(sweep_of(scene, {}), 1).groups[0].periods.least, 7.0 / (2 * pi<double>()));
  EXPECT_EQ(plan_of(sweep_of(scene, {}), 1).groups[0].periods.most, 7.0 / (2 * pi<double>()));
  Scene free;
  free.stops = {-1, 1, 1, 1}, free.start.velocity = 2;
  EXPECT_EQ(plan_of(sweep_of(free, {}), 1).groups[0].periods.most, 1);
}

TEST(Plan, memory_is_that_of_the_run) {
  const Sweep sweep = sweep_of(figure(3), {{Parameter::nu, frequencies()}});
  const Plan plan = plan_of(sweep, 1);
  EXPECT_EQ(plan.need.output, memory_need(sweep).output);
  EXPECT_EQ(plan.need.memory, memory_need(sweep).memory);
  EXPECT_EQ(plan.machine_bytes, memory_limit(1).bytes);
}

TEST(Plan, a_stop_that_no_point_reaches_is_named_with_the_closest_of_all_groups) {
  Scene scene = figure(20);
  scene.oscillator.damping = 0.03;  // the amplitude at resonance is 16.7, and resonant points are another group
  for (const bool all : {false, true}) {
    scene.integration.all_effects = all;
    const Plan plan = plan_of(sweep_of(scene, {{Parameter::nu, frequencies()}}), 1);
    EXPECT_TRUE(warns(plan, "the lower stop is never reached at any point, at the closest |x| <= 16.67 < 20"));
    EXPECT_TRUE(warns(plan, "the upper stop is never reached"));
  }
  EXPECT_FALSE(warns(plan_of(sweep_of(figure(3), {{Parameter::nu, frequencies()}}), 1), "never reached"));
}

TEST(Plan, a_stop_may_be_absent_at_some_points) {
  Scene scene = figure(9);
  for (const std::vector<double>& lower : {std::vector<double>{-infinity, -9, -20}, {-9, -infinity, -20}}) {
    const Plan plan = plan_of(sweep_of(scene, {{Parameter::stop_lower, lower}}), 1);
    EXPECT_TRUE(warns(plan, "the lower stop is never reached"));
  }
  scene.stops.lower = -infinity;
  EXPECT_FALSE(warns(plan_of(sweep_of(scene, {}), 1), "the lower stop"));
}

TEST(Plan, warns_of_motion_that_keeps_its_transient) {
  Scene scene = figure(3);
  scene.oscillator.damping = 0, scene.oscillator.frequency = 1.3;
  scene.stops.restitution_lower = scene.stops.restitution_upper = 1;
  EXPECT_TRUE(warns(plan_of(sweep_of(scene, {}), 1), "never fades"));
  scene.stops.restitution_lower = 0.9;
  EXPECT_FALSE(warns(plan_of(sweep_of(scene, {}), 1), "never fades"));
}

TEST(Plan, along_a_followed_branch_only_the_first_start_is_known) {
  Sweep sweep = sweep_of(figure(6), {{Parameter::R, {0.5, 0.7}}, {Parameter::nu, frequencies()}});
  sweep.follow = 1;
  const Plan plan = plan_of(sweep, 1);
  EXPECT_EQ(plan.branches, 2u);
  ASSERT_EQ(plan.groups.size(), 2u);
  EXPECT_EQ(plan.groups[0].points, 2u);
  EXPECT_FALSE(plan.groups[0].effects.stops());
  EXPECT_TRUE(plan.groups[1].effects.lower && plan.groups[1].effects.upper);
}

}  // namespace
}  // namespace clatter
