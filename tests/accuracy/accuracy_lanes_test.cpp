// Rows of the exact method in SIMD lanes, beside those of the scalar loop.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "accuracy/accuracies.hpp"

namespace clatter::accuracy::accuracy_lanes_test {
namespace {

/// Every test, for every instruction set that this machine has.
class AccuracyInLanes : public testing::TestWithParam<lanes::InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
  /// The rows over the horizon and of the steady motion, in the scalar loop and then in lanes.
  [[nodiscard]] PointAccuracy both(const point::Problem& scene, const AccuracyOptions& options = {.rounds = 0}) const {
    const std::vector<Trial> trials{{TestedMethod::exact, no_setting},
                                    {TestedMethod::steady, 1e-12},
                                    {TestedMethod::exact, no_setting, GetParam()},
                                    {TestedMethod::steady, 1e-12, GetParam()}};
    return measure_accuracy(scene, trials, options);
  }
};

bool is_empty(const WorkPrecision& row) {
  return std::ranges::all_of(row_variables(), [&](const RowVariable& v) { return std::isnan(row.*v.value); });
}

TEST_P(AccuracyInLanes, errs_by_no_more_than_roundings) {
  for (const double nu : {0.8, 1.0, 1.3}) {
    point::Problem scene = smooth_scene();
    scene.oscillator.frequency = nu, scene.oscillator.load = 0.05;
    const PointAccuracy found = both(scene);
    ASSERT_GT(found.impacts, 5.0);
    ASSERT_GT(found.steady_periods, 0.0);
    for (const std::size_t i : {2u, 3u}) {
      const WorkPrecision &scalar = found.rows[i - 2], &lanes = found.rows[i];
      // the bounds that src/accuracy/README.md states for lanes, and that the tests of the scalar loop demand of it
      for (const WorkPrecision* row : {&scalar, &lanes})
        for (const double error : {row->extrema, row->harmonics, row->v_harmonics}) EXPECT_LT(error, 1e-13) << nu;
      EXPECT_EQ(lanes.missed + lanes.extra, 0.0);
      EXPECT_EQ(lanes.status, scalar.status);
      EXPECT_EQ(lanes.observed_periods, scalar.observed_periods);
      for (const double error : {lanes.contact_time, lanes.contact_speed, lanes.rest, lanes.rests_missed})
        EXPECT_TRUE(std::isnan(error)) << "lanes keep no log of impacts and rests";
    }
    EXPECT_EQ(found.rows[2].impacts, found.impacts);
    EXPECT_EQ(found.rows[2].simulated_periods, found.rows[0].simulated_periods);
  }
}

TEST_P(AccuracyInLanes, of_a_transient_has_harmonics_if_it_ends_with_a_forcing_period) {
  point::Problem scene = smooth_scene();
  scene.time.mode = steady::Mode::transient;
  for (const double turns : {3.0, 3.2}) {
    scene.time.duration = turns * period_of(scene.oscillator);
    const WorkPrecision lanes =
        measure_accuracy(scene, {{TestedMethod::exact, no_setting, GetParam()}}, {.rounds = 0}).rows[0];
    EXPECT_LT(lanes.extrema, 1e-13);
    EXPECT_EQ(lanes.missed + lanes.extra, 0.0);
    EXPECT_EQ(std::isnan(lanes.harmonics), turns != 3.0) << "lanes sum only the harmonics of the force";
    if (turns == 3.0) {
      EXPECT_LT(std::max(lanes.harmonics, lanes.v_harmonics), 1e-13);
    }
  }
}

TEST_P(AccuracyInLanes, of_chaotic_motion_errs_as_the_scalar_loop_does) {
  const PointAccuracy found = both(chaotic_scene());
  EXPECT_LT(found.rows[2].extrema, 1e-6);  // 1e-8 within the horizon, multiplied by other roundings
  EXPECT_LT(found.rows[2].harmonics, 1e-6);
  EXPECT_EQ(found.rows[2].missed + found.rows[2].extra, 0.0);
  EXPECT_EQ(found.rows[3].status, steady::Status::aperiodic);
  EXPECT_FALSE(has_errors(found.rows[3]));
}

TEST_P(AccuracyInLanes, counts_the_impacts_of_all_the_periods_of_a_motion) {
  point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -1.3216, 1.3216, 0.7);  // next to grazing
  scene.time.window = 2;
  const PointAccuracy found = both(scene);
  EXPECT_EQ(found.steady_periods, 3.0);
  for (const std::size_t i : {2u, 3u}) EXPECT_EQ(found.rows[i].missed + found.rows[i].extra, 0.0);
  EXPECT_EQ(found.rows[3].observed_periods, 3.0);
  EXPECT_LT(found.rows[3].extrema, 1e-11);  // a graze: the scalar loop errs by 1e-12 in its speeds
}

TEST_P(AccuracyInLanes, from_a_stop_is_neither_missed_nor_doubled) {
  for (const double v : {1.0, -1.0}) {  // into the stop, and away from it
    point::Problem scene = smooth_scene();
    scene.start = {0.5, v, 0.0};
    const WorkPrecision lanes = both(scene).rows[2];
    EXPECT_EQ(lanes.missed + lanes.extra, 0.0) << v;
  }
}

TEST_P(AccuracyInLanes, is_empty_if_the_scalar_loop_runs_the_scene) {
  point::Problem unforced = smooth_scene(), heavy = smooth_scene(), free = smooth_scene();
  unforced.oscillator.forcing = 0, unforced.start.velocity = 3;
  heavy.oscillator.damping = 2;
  free.stops = {-10, 10, 0.7, 0.7};  // lanes would accept it over the horizon, in which it meets no stop
  for (const point::Problem& scene : {unforced, heavy, chattering_scene()}) {
    const PointAccuracy found = both(scene, {.rounds = 1});
    EXPECT_FALSE(is_empty(found.rows[0]));
    EXPECT_TRUE(is_empty(found.rows[2]));
    EXPECT_FALSE(failed(found.rows[2].status)) << "nothing has failed";
  }
  for (const point::Problem& scene : {unforced, heavy, free}) EXPECT_TRUE(is_empty(both(scene).rows[3]));
}

TEST_P(AccuracyInLanes, that_fails_says_why) {
  point::Problem scene = smooth_scene();
  scene.time.max_impacts = 1;
  const PointAccuracy found = both(scene, {.rounds = 1});
  for (const WorkPrecision& row : found.rows) {
    EXPECT_EQ(row.status, steady::Status::event_budget);
    EXPECT_FALSE(has_errors(row));
    EXPECT_TRUE(std::isnan(row.ns_per_period));
  }
}

TEST_P(AccuracyInLanes, gives_the_same_bits_but_for_times_which_every_row_has) {
  std::size_t steps = 0;
  const AccuracyOptions options{.rounds = 2, .progress = [&](auto) { ++steps; }};
  const PointAccuracy timed = both(smooth_scene(), options), untimed = both(smooth_scene());
  EXPECT_EQ(steps, steps_of(4, options));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(std::isfinite(timed.rows[i].ns_per_period) && timed.rows[i].ns_per_period > 0);
    for (const RowVariable& variable : row_variables()) {
      if (variable.value == &WorkPrecision::ns_per_period || variable.value == &WorkPrecision::ns_spread) continue;
      EXPECT_EQ(std::memcmp(&(timed.rows[i].*variable.value), &(untimed.rows[i].*variable.value), sizeof(double)), 0)
          << variable.name << ' ' << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, AccuracyInLanes,
                         testing::Values(lanes::InstructionSet::sse2, lanes::InstructionSet::avx2,
                                         lanes::InstructionSet::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace clatter::accuracy::accuracy_lanes_test
