#include "plan/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plan/available_memory.hpp"
#include "plan/plans.hpp"
#include "plan/survey.hpp"
#include "sweep/figures.hpp"

namespace clatter::plan::plan_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point of Figs. 20-23, its extrema observed.
point::Problem figure(double xs) {
  point::Problem scene = sweep::paper_scene(xs, 1.0);
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
  const sweep::Sweep sweep =
      sweep::sweep_of(figure(3), {{Parameter("nu"), frequencies()}, {Parameter("h"), {0.0, 0.05, 0.1, 1.0, 2.0}}});
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
  point::Problem scene = figure(3);
  scene.time.max_periods = 300;
  const sweep::Axis friction{Parameter("friction"), {0.0, 0.2, 1.5}};
  for (const bool all : {false, true}) {
    scene.integration.all_effects = all;
    const sweep::Sweep sweep = sweep::sweep_of(scene, {friction, {Parameter("nu"), frequencies()}});
    const Plan plan = plan_of(sweep, 2);
    const sweep::RunResult result = run(sweep, {.threads = 2});
    ASSERT_EQ(result.work.size(), plan.groups.size());
    for (std::size_t i = 0; i < plan.groups.size(); ++i) {
      EXPECT_EQ(result.work[i].effects, plan.groups[i].effects);
      EXPECT_EQ(result.work[i].points, plan.groups[i].points);
      EXPECT_GE(result.work[i].periods, plan.groups[i].periods.least);
      EXPECT_LE(result.work[i].periods, plan.groups[i].periods.most);
      EXPECT_GT(plan.groups[i].seconds.least, 0);
      EXPECT_GE(plan.groups[i].seconds.most, plan.groups[i].seconds.least);
    }
  }
}

TEST(Plan, the_work_of_points_that_lanes_take_is_counted_on_its_own) {
  const sweep::Sweep sweep = sweep::sweep_of(
      figure(3), {{Parameter("nu"), frequencies()}, {Parameter("h"), {0.1, 2.0}}});  // too much for lanes
  const sweep::Share share(sweep);
  const Survey scalar = survey_of(sweep, share, {.threads = 1, .arch = lanes::InstructionSet::scalar});
  const Survey lanes = survey_of(sweep, share, {.threads = 1, .arch = lanes::InstructionSet::sse2});
  ASSERT_EQ(lanes.groups.size(), scalar.groups.size());
  double in_lanes = 0;
  for (std::size_t i = 0; i < lanes.groups.size(); ++i) {
    const Collected &one = lanes.groups[i], &other = scalar.groups[i];
    const bool fit = one.effects.stops() && one.effects.damping == Damping::light;
    EXPECT_EQ(one.lane_work.most, fit ? other.work.most : 0);
    EXPECT_EQ(one.work.most, fit ? 0 : other.work.most);
    EXPECT_EQ(other.lane_work.most, 0);
    in_lanes += one.lane_work.most;
  }
  EXPECT_GT(in_lanes, 0);
}

TEST(Plan, the_least_work_of_transients_and_of_conservative_motion_is_the_most) {
  point::Problem scene = figure(3);
  scene.time.mode = steady::Mode::transient, scene.time.duration = 7.0;
  EXPECT_EQ(plan_of(sweep::sweep_of(scene, {}), 1).groups[0].periods.least, 7.0 / (2 * pi<double>()));
  EXPECT_EQ(plan_of(sweep::sweep_of(scene, {}), 1).groups[0].periods.most, 7.0 / (2 * pi<double>()));
  point::Problem free;
  free.stops = {-1, 1, 1, 1}, free.start.velocity = 2;
  EXPECT_EQ(plan_of(sweep::sweep_of(free, {}), 1).groups[0].periods.most, 1);
}

TEST(Plan, memory_is_that_of_the_run) {
  const sweep::Sweep sweep = sweep::sweep_of(figure(3), {{Parameter("nu"), frequencies()}});
  const Plan plan = plan_of(sweep, 1);
  EXPECT_EQ(plan.need.output, memory_need(sweep).output);
  EXPECT_EQ(plan.need.memory, memory_need(sweep).memory);
  EXPECT_EQ(plan.available_memory, memory_limit(1).bytes);
}

TEST(Plan, a_stop_that_no_point_reaches_is_named_with_the_closest_of_all_groups) {
  point::Problem scene = figure(20);
  scene.oscillator.damping = 0.03;  // the amplitude at resonance is 16.7, and resonant points are another group
  for (const bool all : {false, true}) {
    scene.integration.all_effects = all;
    const Plan plan = plan_of(sweep::sweep_of(scene, {{Parameter("nu"), frequencies()}}), 1);
    EXPECT_TRUE(warns(plan, "the lower stop is never reached at any point, at the closest |x| <= 16.67 < 20"));
    EXPECT_TRUE(warns(plan, "the upper stop is never reached"));
  }
  EXPECT_FALSE(warns(plan_of(sweep::sweep_of(figure(3), {{Parameter("nu"), frequencies()}}), 1), "never reached"));
}

TEST(Plan, a_stop_may_be_absent_at_some_points) {
  point::Problem scene = figure(9);
  for (const std::vector<double>& lower : {std::vector<double>{-infinity, -9, -20}, {-9, -infinity, -20}}) {
    const Plan plan = plan_of(sweep::sweep_of(scene, {{Parameter("stop_lower"), lower}}), 1);
    EXPECT_TRUE(warns(plan, "the lower stop is never reached"));
  }
  scene.stops.lower = -infinity;
  EXPECT_FALSE(warns(plan_of(sweep::sweep_of(scene, {}), 1), "the lower stop"));
}

TEST(Plan, warns_of_motion_that_keeps_its_transient) {
  point::Problem scene = figure(3);
  scene.oscillator.damping = 0, scene.oscillator.frequency = 1.3;
  scene.stops.restitution_lower = scene.stops.restitution_upper = 1;
  EXPECT_TRUE(warns(plan_of(sweep::sweep_of(scene, {}), 1), "never fades"));
  point::Problem rubbing = scene;
  rubbing.friction = {0.1, 0.1};
  EXPECT_FALSE(warns(plan_of(sweep::sweep_of(rubbing, {}), 1), "never fades"));
  scene.stops.restitution_lower = 0.9;
  EXPECT_FALSE(warns(plan_of(sweep::sweep_of(scene, {}), 1), "never fades"));
}

TEST(Plan, of_a_mass_that_friction_never_lets_go_is_a_period) {
  point::Problem scene = figure(3);
  scene.friction = {0.5, 1.5};
  const Plan plan = plan_of(sweep::sweep_of(scene, {{Parameter("nu"), frequencies()}}), 1);
  ASSERT_EQ(plan.groups.size(), 1u);
  EXPECT_EQ(plan.groups[0].periods.least, static_cast<double>(plan.points));
  EXPECT_EQ(plan.groups[0].periods.most, static_cast<double>(plan.points));
  EXPECT_TRUE(warns(plan, "the upper stop is never reached at any point, at the closest |x| <= 0 < 3"));
}

TEST(Plan, along_a_followed_chain_only_the_first_start_is_known) {
  sweep::Sweep sweep = sweep::sweep_of(figure(6), {{Parameter("R"), {0.5, 0.7}}, {Parameter("nu"), frequencies()}});
  sweep.follow = 1;
  const Plan plan = plan_of(sweep, 1);
  EXPECT_EQ(plan.chains, 2u);
  ASSERT_EQ(plan.groups.size(), 2u);
  EXPECT_EQ(plan.groups[0].points, 2u);
  EXPECT_FALSE(plan.groups[0].effects.stops());
  EXPECT_TRUE(plan.groups[1].effects.lower && plan.groups[1].effects.upper);
}

std::vector<double> evenly(double first, double last, int number) {
  std::vector<double> all;
  for (int i = 0; i < number; ++i) all.push_back(first + (last - first) * i / (number - 1));
  return all;
}

/// 2.5 million points in nine or more groups.
sweep::Sweep large_sweep() {
  return sweep::sweep_of(figure(3), {{Parameter("h"), evenly(0.0, 2.0, 100)},
                                     {Parameter("f"), evenly(-3.5, 0.0, 250)},
                                     {Parameter("nu"), evenly(0.5, 1.5, 100)}});
}

TEST(Plan, of_a_large_sweep_is_that_of_all_points_within_the_error_of_a_sample) {
  const sweep::Sweep sweep = large_sweep();
  const Plan sampled = plan_of(sweep, 2);
  EXPECT_EQ(sampled.sampled_points, 1'000'000u);
  EXPECT_EQ(sampled.points, 2'500'000u);
  std::vector<Group> exact;
  for (std::size_t number = 0; number < 4; ++number) {  // the shards are small enough to be examined as a whole
    const Plan part = plan_of(sweep, 2, results::Shard{number, 4});
    EXPECT_EQ(part.sampled_points, std::nullopt);
    EXPECT_EQ(part.points, 625'000u);
    for (const Group& group : part.groups) {
      const auto same = std::ranges::find(exact, group.effects, &Group::effects);
      if (same == exact.end()) {
        exact.push_back(group);
      } else {
        same->points += group.points, same->periods += group.periods;
      }
    }
  }
  EXPECT_GT(exact.size(), 8u);
  std::size_t total = 0;
  for (const Group& group : sampled.groups) {
    total += group.points;
    const auto whole = std::ranges::find(exact, group.effects, &Group::effects);
    ASSERT_NE(whole, exact.end());
    const double points = static_cast<double>(whole->points), share = points / 2.5e6;
    const double sigma = 2.5 * std::sqrt(1e6 * share * (1 - share));  // that of random draws; stretches only lower it
    EXPECT_NEAR(static_cast<double>(group.points), points, 4 * sigma + 3);
    EXPECT_NEAR(group.periods.most / whole->periods.most, 1, (4 * sigma + 3) / points);  // equal for all of a group
  }
  EXPECT_EQ(total, 2'500'000u);
}

TEST(Plan, of_a_sample_is_the_same_for_every_number_of_threads) {
  const sweep::Sweep sweep = large_sweep();
  const Plan one = plan_of(sweep, 1), three = plan_of(sweep, 3);
  ASSERT_EQ(three.groups.size(), one.groups.size());
  for (std::size_t i = 0; i < one.groups.size(); ++i) {
    EXPECT_EQ(three.groups[i].points, one.groups[i].points);
    EXPECT_EQ(three.groups[i].example, one.groups[i].example);
    EXPECT_EQ(three.groups[i].periods.least, one.groups[i].periods.least);
    EXPECT_EQ(three.groups[i].periods.most, one.groups[i].periods.most);
  }
}

TEST(Plan, of_a_large_followed_sweep_knows_how_many_points_begin_a_chain) {
  sweep::Sweep sweep =
      sweep::sweep_of(figure(6), {{Parameter("R"), {0.5, 0.7}}, {Parameter("nu"), evenly(0.5, 1.5, 1'000'000)}});
  sweep.follow = 1;
  const Plan plan = plan_of(sweep, 2);
  EXPECT_EQ(plan.sampled_points, 1'000'000u);
  ASSERT_EQ(plan.groups.size(), 2u);
  EXPECT_EQ(plan.groups[0].points, 2u);
  EXPECT_EQ(plan.groups[1].points, 1'999'998u);
}

TEST(Plan, of_a_sample_says_so_of_a_stop_that_it_never_meets) {
  const sweep::Sweep sweep = sweep::sweep_of(
      figure(9), {{Parameter("nu"), evenly(0.5, 1.5, 2000)}, {Parameter("f"), evenly(-1.0, 1.0, 1000)}});
  const Plan plan = plan_of(sweep, 2);
  EXPECT_TRUE(warns(plan, "the lower stop is reached at none of the 1000000 points examined, at the closest |x| <= "));
  EXPECT_FALSE(warns(plan, "never reached"));
}

TEST(Plan, of_a_shard_is_that_of_its_points) {
  const sweep::Sweep sweep = sweep::sweep_of(figure(3), {{Parameter("nu"), frequencies()}});
  const results::Shard shard{1, 3};
  const Plan plan = plan_of(sweep, 1, shard);
  EXPECT_EQ(plan.points, sweep::Share(sweep, shard).points());
  EXPECT_EQ(plan.chains, plan.points);
  EXPECT_EQ(plan.need.output, memory_need(sweep, shard, 1).output);
  EXPECT_EQ(plan.need.memory, memory_need(sweep, shard, 1).memory);
  std::size_t points = 0;
  for (const Group& group : plan.groups) {
    points += group.points;
    EXPECT_EQ(group.example % 3, 1u);
  }
  EXPECT_EQ(points, plan.points);
  const Plan empty = plan_of(sweep, 1, results::Shard{102, 103});
  EXPECT_EQ(empty.points, 0u);
  EXPECT_TRUE(empty.groups.empty());
}

}  // namespace
}  // namespace clatter::plan::plan_test
