// Accuracy runs of motion that can't be compared, or not for long; and that a run can be repeated, followed, stopped.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "accuracy/accuracies.hpp"

namespace clatter::accuracy::accuracy_edges_test {
namespace {

const AccuracyOptions once{.rounds = 1};

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

point::Problem transient_scene() {
  point::Problem scene = smooth_scene();
  scene.time.mode = steady::Mode::transient, scene.time.duration = 20.0;  // 3.18 forcing periods
  return scene;
}
/// Free vibration that damping ends: impacts only at first.
point::Problem unforced_scene() {
  point::Problem scene = support::scene_of({0.1, 0.0, 1.0, 0.0}, -0.5, 0.5, 0.5);
  scene.start.velocity = 3.0, scene.time.window = 3;
  return scene;
}
/// More impacts than are allowed, before the end of the first period.
point::Problem failing_scene() {
  point::Problem scene = smooth_scene();
  scene.time.max_impacts = 1;
  return scene;
}

TEST(StartOnAStop, moving_in_is_neither_missed_nor_doubled) {
  point::Problem scene = smooth_scene();
  scene.start = {0.5, 1.0, 0.0};
  const PointAccuracy found =
      measure_accuracy(scene, {{TestedMethod::exact, no_setting}, {TestedMethod::dopri5, 1e-8}}, once);
  for (const WorkPrecision& row : found.rows) EXPECT_EQ(row.missed + row.extra, 0.0);
  EXPECT_EQ(row_of(found, TestedMethod::exact).impacts, found.impacts);
}

TEST(SteadyMotion, is_the_same_however_loose_the_tolerance_of_the_scene_is) {
  point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -1.3216, 1.3216,
                                           0.7);  // near grazing, where a loose tolerance finds another motion
  scene.time.window = 2, scene.time.tolerance = 1e-3;
  const PointAccuracy found = measure_accuracy(scene, one_of_each(), once);
  EXPECT_EQ(found.steady_periods, 3.0);
  EXPECT_LT(row_of(found, TestedMethod::harmonics_exact).harmonics, 1e-13);
  const PointAccuracy loose = measure_accuracy(scene, {{TestedMethod::steady, 1e-3}}, once);
  EXPECT_EQ(loose.rows[0].observed_periods, 1.0);  // another motion: it has no error
  for (const double error : errors_of(loose.rows[0])) EXPECT_TRUE(std::isnan(error));
}

TEST(RestingMotion, has_harmonics_in_units_of_its_own_size) {
  point::Problem scene = smooth_scene();
  scene.oscillator.load = 3.0, scene.time.window = 2;  // it ends at rest on the upper stop: its harmonics are rounding
  const PointAccuracy found = measure_accuracy(scene, {{TestedMethod::harmonics_fft, 1024}}, once);
  EXPECT_LT(found.rows[0].harmonics, 1e-14);
  EXPECT_LT(found.rows[0].v_harmonics, 1e-14);
}

TEST(ChaoticScene, is_compared_while_double_follows_fifty_digits) {
  const PointAccuracy found = measure_accuracy(chaotic_scene(), one_of_each(), once);
  EXPECT_EQ(found.asked, 200.0);
  EXPECT_LT(found.horizon, 180.0);  // eight digits of sixteen, at some ten periods each
  EXPECT_GT(found.horizon, 20.0);
  EXPECT_EQ(found.horizon, std::floor(found.horizon));
  EXPECT_TRUE(std::isnan(found.steady_periods));
  const WorkPrecision& exact = row_of(found, TestedMethod::exact);
  EXPECT_NEAR(exact.simulated_periods, found.horizon, 1e-12);  // through tau and back
  EXPECT_EQ(exact.impacts, found.impacts);
  EXPECT_EQ(sum_of_faults(exact), 0.0);
  EXPECT_GT(exact.contact_time, 1e-14);  // errors have grown
  EXPECT_LT(exact.contact_time, 1e-8);   // but not beyond what counts as agreement
  EXPECT_GT(sum_of_faults(row_of(found, TestedMethod::moreau)), 0.0);
  for (const TestedMethod method : {TestedMethod::steady, TestedMethod::steady_repetition}) {
    EXPECT_EQ(row_of(found, method).status, steady::Status::aperiodic);
    EXPECT_FALSE(has_errors(row_of(found, method)));
  }
  EXPECT_LT(row_of(found, TestedMethod::harmonics_exact).harmonics, 1e-8);
}

TEST(UnforcedScene, is_compared_from_its_start_alone) {
  const PointAccuracy found = measure_accuracy(unforced_scene(), one_of_each(), once);
  EXPECT_EQ(found.horizon, 3.0);
  EXPECT_GT(found.impacts, 0.0);
  EXPECT_TRUE(std::isnan(found.steady_periods));
  const WorkPrecision& exact = row_of(found, TestedMethod::exact);
  EXPECT_LT(exact.contact_time, 1e-14);
  EXPECT_LT(exact.harmonics, 1e-13);
  EXPECT_EQ(sum_of_faults(exact), 0.0);
  EXPECT_GT(row_of(found, TestedMethod::dopri5).contact_time, 1e-12);
  EXPECT_FALSE(has_errors(row_of(found, TestedMethod::steady)));
}

TEST(TransientScene, is_compared_over_its_duration) {
  const PointAccuracy found = measure_accuracy(
      transient_scene(), trials_of(steady::Mode::transient, lanes::InstructionSet::scalar), {.rounds = 0});
  EXPECT_DOUBLE_EQ(found.asked, 20 / (2 * std::numbers::pi));
  EXPECT_EQ(found.horizon, found.asked);
  EXPECT_EQ(found.impacts, 6.0);
  EXPECT_TRUE(std::isnan(found.steady_periods));
  for (const WorkPrecision& row : found.rows) {
    EXPECT_EQ(row.status, steady::Status::transient);
    EXPECT_EQ(row.simulated_periods, found.horizon);
    EXPECT_EQ(row.impacts, 6.0);
  }
  EXPECT_LT(row_of(found, TestedMethod::exact).contact_time, 1e-14);
  EXPECT_LT(row_of(found, TestedMethod::harmonics_exact).harmonics, 1e-13);
}

TEST(TransientScene, sampled_harmonics_converge_if_it_does_not_end_with_a_forcing_period) {
  std::vector<Trial> trials;
  for (int power = 8; power <= 16; ++power) trials.push_back({TestedMethod::harmonics_fft, std::exp2(power)});
  const PointAccuracy found = measure_accuracy(transient_scene(), trials, {.rounds = 0});
  // the motion doesn't end in the state in which it began: a jump, for samples of x too
  EXPECT_NEAR(order_of(found, &WorkPrecision::harmonics), -1.0, 0.2);
  EXPECT_LT(found.rows.back().harmonics, 1e-4);
}

TEST(FailingScene, has_no_errors_and_says_why) {
  const PointAccuracy found = measure_accuracy(failing_scene(), one_of_each(), once);
  EXPECT_EQ(found.horizon, 0.0);
  EXPECT_EQ(found.impacts, 0.0);
  for (const WorkPrecision& row : found.rows) {
    EXPECT_EQ(row.status, steady::Status::event_budget) << method_names[static_cast<std::size_t>(row.trial.method)];
    EXPECT_FALSE(has_errors(row));
    EXPECT_TRUE(std::isnan(row.ns_per_period)) << "a run that did not complete has no time a period";
    EXPECT_TRUE(std::isnan(row.ns_spread));
  }
}

TEST(FailingScene, that_fails_while_it_settles_is_compared_from_its_start) {
  point::Problem scene = smooth_scene();
  scene.time.max_impacts = 13;  // 12 in the window, more until it repeats
  const PointAccuracy found = measure_accuracy(scene, one_of_each(), once);
  EXPECT_EQ(found.horizon, 6.0);
  EXPECT_TRUE(std::isnan(found.steady_periods));
  EXPECT_EQ(row_of(found, TestedMethod::exact).status, steady::Status::transient);
  EXPECT_LT(row_of(found, TestedMethod::exact).contact_time, 1e-14);
  for (const TestedMethod method : {TestedMethod::steady, TestedMethod::steady_repetition}) {
    EXPECT_EQ(row_of(found, method).status, steady::Status::event_budget);
    EXPECT_FALSE(has_errors(row_of(found, method)));
  }
}

TEST(SceneWithoutImpacts, has_no_errors_of_contacts) {
  point::Problem scene = smooth_scene();
  scene.stops.lower = -10, scene.stops.upper = 10, scene.time.window = 2;
  const PointAccuracy found = measure_accuracy(scene, one_of_each(), once);
  EXPECT_EQ(found.impacts, 0.0);
  for (const TestedMethod method : {TestedMethod::exact, TestedMethod::dopri5, TestedMethod::steady}) {
    const WorkPrecision& row = row_of(found, method);
    for (const double error : {row.contact_time, row.contact_speed, row.rest})
      EXPECT_TRUE(std::isnan(error)) << "there is nothing to compare";
    EXPECT_EQ(sum_of_faults(row), 0.0);
    EXPECT_LT(row.extrema, 1e-4);
  }
}

void expect_same_but_for_times(const PointAccuracy& one, const PointAccuracy& other) {
  for (const PointVariable& variable : point_variables())
    EXPECT_TRUE(same_bits(one.*variable.value, other.*variable.value)) << variable.name;
  ASSERT_EQ(one.rows.size(), other.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    EXPECT_EQ(one.rows[i].status, other.rows[i].status);
    for (const RowVariable& variable : row_variables()) {
      if (variable.value == &WorkPrecision::ns_per_period || variable.value == &WorkPrecision::ns_spread) continue;
      EXPECT_TRUE(same_bits(one.rows[i].*variable.value, other.rows[i].*variable.value)) << variable.name << ' ' << i;
    }
  }
}

TEST(Accuracy, gives_the_same_bits_but_for_times) {
  for (const point::Problem& scene :
       {chattering_scene(), chaotic_scene(), transient_scene(), unforced_scene(), failing_scene()})
    expect_same_but_for_times(measure_accuracy(scene, one_of_each(), once),
                              measure_accuracy(scene, one_of_each(), {.rounds = 0}));
}

TEST(Accuracy, takes_no_method_and_no_observables_from_the_scene) {
  const PointAccuracy plain = measure_accuracy(chattering_scene(), one_of_each(), {.rounds = 0});
  for (const stepping::Method method : {stepping::Method::exact, stepping::Method::dopri5, stepping::Method::moreau}) {
    point::Problem scene = chattering_scene();
    scene.integration.method = method, scene.integration.all_effects = true;
    scene.integration.tolerance = 1e-2, scene.integration.step = 0.1;
    scene.observe = {};
    scene.observe.extrema = true;
    scene.observe.harmonics = 5;
    scene.observe.harmonics_samples = 64;
    scene.observe.impacts = true;
    scene.observe.trajectory = 100;
    scene.observe.stability = true;
    expect_same_but_for_times(measure_accuracy(scene, one_of_each(), {.rounds = 0}), plain);
  }
}

TEST(Accuracy, measures_the_time_of_every_row_that_runs) {
  const PointAccuracy found = measure_accuracy(smooth_scene(), one_of_each(), {.rounds = 2});
  for (const WorkPrecision& row : found.rows) {
    EXPECT_TRUE(std::isfinite(row.ns_per_period) && row.ns_per_period > 0);
    EXPECT_TRUE(std::isfinite(row.ns_spread) && row.ns_spread >= 0);
  }
  for (const WorkPrecision& row : measure_accuracy(smooth_scene(), one_of_each(), once).rows)
    EXPECT_TRUE(std::isfinite(row.ns_per_period) && std::isnan(row.ns_spread)) << "a single time has no spread";
}

TEST(Accuracy, makes_as_much_progress_as_it_said) {
  for (const int rounds : {0, 1, 3}) {
    for (const point::Problem& scene : {smooth_scene(), transient_scene(), unforced_scene(), failing_scene()}) {
      std::size_t steps = 0;
      const AccuracyOptions options{.rounds = rounds, .progress = [&](auto) { ++steps; }};
      const auto rows = measure_accuracy(scene, one_of_each(), options).rows;
      EXPECT_EQ(steps, steps_of(rows.size(), options)) << rounds << " rounds, f = " << scene.oscillator.forcing
                                                       << ", at most " << scene.time.max_impacts << " impacts";
    }
  }
}

TEST(Accuracy, stopped_before_it_begins_runs_nothing) {
  std::size_t steps = 0;
  const PointAccuracy found = measure_accuracy(smooth_scene(), one_of_each(),
                                               {.progress = [&](auto) { ++steps; }, .stopped = [] { return true; }});
  EXPECT_EQ(steps, 0u);
  EXPECT_EQ(found.rows.size(), one_of_each().size());
  for (const WorkPrecision& row : found.rows) {
    EXPECT_FALSE(has_errors(row));
    EXPECT_TRUE(std::isnan(row.ns_per_period) && std::isnan(row.impacts));
  }
}

TEST(Accuracy, stops_wherever_it_is_told_to) {
  std::size_t asked = 0;
  (void)measure_accuracy(smooth_scene(), one_of_each(), {.rounds = 1, .stopped = [&] { return ++asked == 0; }});
  const std::size_t all = asked;
  ASSERT_GT(all, 2 * one_of_each().size());
  std::size_t most = 0;
  for (std::size_t last = 1; last <= all; ++last) {
    std::size_t questions = 0, steps = 0, steps_after = 0;
    bool told = false;
    const AccuracyOptions options{.rounds = 1,
                                  .progress = [&](auto) { ++steps, steps_after += told; },
                                  .stopped = [&] { return told = ++questions >= last; }};
    (void)measure_accuracy(smooth_scene(), one_of_each(), options);
    EXPECT_EQ(steps_after, 0u) << "told at question " << last;
    EXPECT_GE(steps, most);
    most = steps;
  }
  EXPECT_LT(most, steps_of(one_of_each().size(), {.rounds = 1}));
  EXPECT_GT(most, one_of_each().size());
}

}  // namespace
}  // namespace clatter::accuracy::accuracy_edges_test
