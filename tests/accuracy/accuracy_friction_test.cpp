// Accuracy runs of scenes with dry friction, whose sticks are compared as rests are.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "accuracy/accuracies.hpp"
#include "support/friction_scenes.hpp"

namespace clatter::accuracy::accuracy_friction_test {
namespace {

const AccuracyOptions once{.rounds = 1};

/// Impacts on both stops and a stick in each period.
point::Problem sticking_scene() {
  point::Problem scene = support::rubbing_with_a_stick();
  scene.time.window = 16;
  return scene;
}

std::vector<double> sizes_of_errors(const WorkPrecision& row) {
  return {row.contact_time, row.contact_speed, row.rest, row.extrema, row.harmonics, row.v_harmonics};
}

TEST(StickingScene, is_exact_in_every_column) {
  const PointAccuracy found = measure_accuracy(sticking_scene(), one_of_each(), once);
  EXPECT_EQ(found.horizon, 16.0);
  EXPECT_GT(found.impacts, 28.0);
  EXPECT_GE(found.rests, 8.0);  // the sticks
  EXPECT_EQ(found.steady_periods, 1.0);
  const WorkPrecision& exact = row_of(found, TestedMethod::exact);
  for (const double error : sizes_of_errors(exact)) EXPECT_LT(error, 1e-13);  // roundings of contracting motion
  EXPECT_EQ(sum_of_faults(exact), 0.0);
  EXPECT_EQ(exact.impacts, found.impacts);
  const WorkPrecision& harmonics = row_of(found, TestedMethod::harmonics_exact);
  EXPECT_LT(std::max(harmonics.harmonics, harmonics.v_harmonics), 1e-12);  // on a motion that has settled to 1e-12
  const WorkPrecision& repeated = row_of(found, TestedMethod::steady_repetition);
  EXPECT_EQ(repeated.status, steady::Status::periodic);
  for (const double error : sizes_of_errors(repeated)) EXPECT_LT(error, repeated.trial.setting);
  EXPECT_EQ(sum_of_faults(repeated), 0.0);
}

TEST(StickingScene, general_methods_err_in_proportion_to_tolerance_and_step) {
  std::vector<Trial> steps;
  for (const double step : {1e-3, 3e-4, 1e-4, 3e-5, 1e-5}) steps.push_back({TestedMethod::moreau, step});
  const PointAccuracy dopri5 = measure_accuracy(sticking_scene(), decades(TestedMethod::dopri5, 4, 12), once),
                      moreau = measure_accuracy(sticking_scene(), steps, once);
  for (const auto error : {&WorkPrecision::contact_time, &WorkPrecision::contact_speed, &WorkPrecision::rest,
                           &WorkPrecision::extrema, &WorkPrecision::harmonics, &WorkPrecision::v_harmonics}) {
    EXPECT_NEAR(order_of(dopri5, error), 1.0, 0.15);
    EXPECT_NEAR(order_of(moreau, error), 1.0, 0.3);  // the place of events within their steps is chance
  }
  for (const PointAccuracy& found : {dopri5, moreau})
    for (const WorkPrecision& row : found.rows) {
      EXPECT_EQ(sum_of_faults(row), 0.0) << row.trial.setting;
      EXPECT_LT(row.rest, found.impacts * row.trial.setting);  // a step's error at each impact before
    }
}

TEST(StickingScene, is_not_run_in_lanes) {
  const PointAccuracy found = measure_accuracy(sticking_scene(),
                                               {{TestedMethod::exact, no_setting},
                                                {TestedMethod::exact, no_setting, lanes::InstructionSet::sse2},
                                                {TestedMethod::steady, 1e-12, lanes::InstructionSet::sse2}},
                                               once);
  EXPECT_TRUE(has_errors(found.rows[0]));
  for (const std::size_t in_lanes : {1u, 2u}) {
    EXPECT_FALSE(has_errors(found.rows[in_lanes]));
    EXPECT_FALSE(failed(found.rows[in_lanes].status)) << "nothing has failed";
  }
}

TEST(RubbingChatter, is_compared_to_the_end_though_fifty_digits_take_more_of_it) {
  point::Problem scene = chattering_scene();
  scene.friction = {0.1, 0.2};
  const PointAccuracy found = measure_accuracy(
      scene, {{TestedMethod::exact, no_setting}, {TestedMethod::dopri5, 1e-9}, {TestedMethod::moreau, 1e-4}}, once);
  EXPECT_EQ(found.horizon, 4.0);
  EXPECT_GT(found.rests, 3.0);
  for (const double error : sizes_of_errors(found.rows[0])) EXPECT_LT(error, 1e-13);
  for (const std::size_t i : {0u, 1u}) EXPECT_EQ(sum_of_faults(found.rows[i]), 0.0);
  EXPECT_EQ(found.rows[2].rests_missed, 0.0);
  EXPECT_LT(found.rows[1].rest, 1e-8);
  EXPECT_LT(found.rows[2].rest, 1e-2);
}

TEST(StuckScene, has_one_rest_and_no_impact) {
  point::Problem scene = sticking_scene();
  scene.friction = {0.2, 1.5};
  const PointAccuracy found = measure_accuracy(scene, one_of_each(), once);
  EXPECT_EQ(found.horizon, 16.0);
  EXPECT_EQ(found.impacts, 0.0);
  EXPECT_EQ(found.rests, 1.0);
  for (const TestedMethod method : {TestedMethod::exact, TestedMethod::dopri5, TestedMethod::moreau}) {
    EXPECT_EQ(sum_of_faults(row_of(found, method)), 0.0);
    EXPECT_EQ(row_of(found, method).rest, 0.0);
  }
}

}  // namespace
}  // namespace clatter::accuracy::accuracy_friction_test
