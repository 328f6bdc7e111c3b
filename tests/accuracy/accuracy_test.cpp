// Accuracy runs of scenes with known answers: orders of convergence, and that the exact method's error has none.

#include "accuracy/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/accuracies.hpp"

namespace clatter::accuracy::accuracy_test {
namespace {

const AccuracyOptions once{.rounds = 1};

TEST(Trials, cover_the_range_of_every_method) {
  const auto trials = trials_of(steady::Mode::steady, lanes::InstructionSet::scalar),
             transient = trials_of(steady::Mode::transient, lanes::InstructionSet::scalar);
  const auto count = [](const std::vector<Trial>& all, TestedMethod method) {
    return std::ranges::count(all, method, &Trial::method);
  };
  const std::pair<TestedMethod, int> counts[] = {{TestedMethod::exact, 1},
                                                 {TestedMethod::dopri5, 11},
                                                 {TestedMethod::moreau, 5},
                                                 {TestedMethod::harmonics_exact, 1},
                                                 {TestedMethod::harmonics_fft, 17},
                                                 {TestedMethod::steady, 12},
                                                 {TestedMethod::steady_repetition, 12}};
  for (const auto& [method, number] : counts) {
    const bool of_repeats = method >= TestedMethod::steady;
    EXPECT_EQ(count(trials, method), number);
    EXPECT_EQ(count(transient, method), of_repeats ? 0 : number);
  }
  for (const Trial& trial : trials) {
    const bool set = trial.method != TestedMethod::exact && trial.method != TestedMethod::harmonics_exact;
    EXPECT_EQ(std::isnan(trial.setting), !set);
    if (trial.method == TestedMethod::harmonics_fft) {
      EXPECT_EQ(std::exp2(std::round(std::log2(trial.setting))), trial.setting);
    }
  }
  EXPECT_EQ(trials[1].setting, 1e-3);
  EXPECT_EQ(trials.back().setting, 1e-14);
}

TEST(Trials, in_lanes_stand_beside_those_of_the_scalar_loop) {
  for (const steady::Mode mode : {steady::Mode::steady, steady::Mode::transient}) {
    const auto scalar = trials_of(mode, lanes::InstructionSet::scalar);
    auto both = trials_of(mode, lanes::InstructionSet::avx2);
    EXPECT_EQ(both[1].method, TestedMethod::exact);
    EXPECT_EQ(both[1].arch, lanes::InstructionSet::avx2);
    EXPECT_EQ(both.size(), scalar.size() + (mode == steady::Mode::steady ? 2 : 1));
    std::erase_if(both, [](const Trial& trial) {
      return trial.arch == lanes::InstructionSet::avx2 &&
             (trial.method == TestedMethod::exact || trial.setting == 1e-12);
    });
    ASSERT_EQ(both.size(), scalar.size());
    for (std::size_t i = 0; i < both.size(); ++i) {
      EXPECT_EQ(both[i].method, scalar[i].method);
      EXPECT_EQ(both[i].arch, lanes::InstructionSet::scalar);
      EXPECT_EQ(scalar[i].arch, lanes::InstructionSet::scalar);
    }
  }
}

TEST(SmoothScene, is_exact_in_every_column) {
  const PointAccuracy found = measure_accuracy(smooth_scene(), one_of_each(), once);
  EXPECT_EQ(found.asked, 6.0);
  EXPECT_EQ(found.horizon, 6.0);
  EXPECT_EQ(found.impacts, 12.0);
  EXPECT_EQ(found.rests, 0.0);
  EXPECT_EQ(found.steady_periods, 1.0);
  const WorkPrecision& exact = row_of(found, TestedMethod::exact);
  // roundings of a dozen contracting impacts: some 1e-15
  for (const double error :
       {exact.contact_time, exact.contact_speed, exact.extrema, exact.harmonics, exact.v_harmonics})
    EXPECT_LT(error, 1e-13);
  EXPECT_EQ(sum_of_faults(exact), 0.0);
  EXPECT_EQ(exact.impacts, 12.0);
  EXPECT_EQ(exact.simulated_periods, 6.0);
  EXPECT_EQ(exact.status, steady::Status::transient);
  const WorkPrecision& harmonics = row_of(found, TestedMethod::harmonics_exact);
  EXPECT_LT(harmonics.harmonics, 1e-12);  // on a motion that has settled to 1e-12
  EXPECT_LT(harmonics.v_harmonics, 1e-12);
  for (const double error : {harmonics.contact_time, harmonics.extrema, harmonics.missed})
    EXPECT_TRUE(std::isnan(error));
  EXPECT_EQ(row_of(found, TestedMethod::steady).status, steady::Status::periodic);
}

TEST(SmoothScene, dopri5_errs_in_proportion_to_its_tolerance) {
  const PointAccuracy found = measure_accuracy(smooth_scene(), decades(TestedMethod::dopri5, 3, 12), once);
  // the pair controls the error of a unit step, with a safety that varies by a factor of a few
  for (const auto error : {&WorkPrecision::contact_time, &WorkPrecision::contact_speed, &WorkPrecision::extrema,
                           &WorkPrecision::harmonics, &WorkPrecision::v_harmonics})
    EXPECT_NEAR(order_of(found, error), 1.0, 0.15);
  for (const WorkPrecision& row : found.rows) {
    EXPECT_LT(row.contact_time, row.trial.setting);
    EXPECT_GT(row.contact_time, 1e-3 * row.trial.setting);
    EXPECT_EQ(sum_of_faults(row), 0.0);
  }
  for (std::size_t i = 1; i < found.rows.size(); ++i)
    EXPECT_GT(found.rows[i].evaluations, found.rows[i - 1].evaluations);
}

TEST(SmoothScene, moreau_errs_in_proportion_to_its_step) {
  const PointAccuracy found = measure_accuracy(smooth_scene(), decades(TestedMethod::moreau, 1, 5), once);
  // the position of an impact in its step is chance: a factor of several either way, over four decades of steps
  for (const auto error : {&WorkPrecision::contact_time, &WorkPrecision::contact_speed, &WorkPrecision::extrema,
                           &WorkPrecision::harmonics, &WorkPrecision::v_harmonics})
    EXPECT_NEAR(order_of(found, error), 1.0, 0.3);
  for (const WorkPrecision& row : found.rows) EXPECT_LT(row.contact_time, 4 * row.trial.setting);
}

TEST(SmoothScene, sampled_harmonics_converge_in_the_second_order_and_those_of_velocity_in_the_first) {
  std::vector<Trial> trials;
  for (int power = 4; power <= 16; ++power) trials.push_back({TestedMethod::harmonics_fft, std::exp2(power)});
  const PointAccuracy found = measure_accuracy(smooth_scene(), trials, once);
  // x has kinks at the impacts and v has jumps, whose position between two samples is chance
  EXPECT_NEAR(order_of(found, &WorkPrecision::harmonics), -2.0, 0.3);
  EXPECT_NEAR(order_of(found, &WorkPrecision::v_harmonics), -1.0, 0.3);
  for (const WorkPrecision& row : found.rows) {
    EXPECT_LT(row.harmonics, 20 / std::pow(row.trial.setting, 2));
    EXPECT_LT(row.v_harmonics, 20 / row.trial.setting);
    EXPECT_EQ(row.simulated_periods, 1.0);
  }
}

TEST(SmoothScene, repeats_are_as_exact_as_they_are_asked_to_be) {
  const PointAccuracy repetition =
      measure_accuracy(smooth_scene(), decades(TestedMethod::steady_repetition, 3, 13), once);
  for (const WorkPrecision& row : repetition.rows) {
    EXPECT_EQ(row.status, steady::Status::periodic);
    EXPECT_EQ(sum_of_faults(row), 0.0);
    // states a period apart are that near, and contract further by more than a half each period; then roundings
    for (const double error : {row.contact_time, row.contact_speed, row.extrema, row.harmonics, row.v_harmonics})
      EXPECT_LT(error, row.trial.setting + 1e-13) << row.trial.setting;
  }
  for (std::size_t i = 1; i < repetition.rows.size(); ++i)
    EXPECT_GT(repetition.rows[i].simulated_periods, repetition.rows[i - 1].simulated_periods);
  // Newton's method pays from five digits on; below them it may take a period more than repetition
  const PointAccuracy newton = measure_accuracy(smooth_scene(), decades(TestedMethod::steady, 5, 13), once);
  for (std::size_t i = 0; i < newton.rows.size(); ++i) {
    EXPECT_LT(newton.rows[i].simulated_periods, repetition.rows[i + 2].simulated_periods)
        << newton.rows[i].trial.setting;
    EXPECT_LT(newton.rows[i].contact_time, 1e-14);
    EXPECT_LT(newton.rows[i].extrema, newton.rows[i].trial.setting + 1e-13);
  }
}

TEST(ChatteringScene, is_exact_and_nothing_is_missed_or_doubled) {
  const PointAccuracy found = measure_accuracy(chattering_scene(), one_of_each(), once);
  EXPECT_EQ(found.horizon, 4.0);
  EXPECT_GT(found.impacts, 50.0);
  EXPECT_EQ(found.rests, 1.0);
  const WorkPrecision& exact = row_of(found, TestedMethod::exact);
  EXPECT_EQ(exact.missed, 0.0);
  EXPECT_EQ(exact.extra, 0.0);
  EXPECT_EQ(exact.rests_missed, 0.0);
  EXPECT_EQ(exact.impacts, found.impacts);
  for (const double error :
       {exact.contact_time, exact.contact_speed, exact.rest, exact.extrema, exact.harmonics, exact.v_harmonics})
    EXPECT_LT(error, 1e-13);  // roundings
}

TEST(ChatteringScene, general_methods_miss_flights_shorter_than_their_steps) {
  const PointAccuracy moreau = measure_accuracy(chattering_scene(), decades(TestedMethod::moreau, 1, 3), once);
  EXPECT_EQ(moreau.rows[0].rests_missed, 1.0);
  EXPECT_GT(moreau.rows[0].missed, moreau.rows[2].missed);
  for (const WorkPrecision& row : moreau.rows) {
    EXPECT_GT(row.missed, 0.0);
    EXPECT_LE(row.missed, moreau.impacts);
  }
  for (const std::size_t i : {1u, 2u}) {  // as late as the impacts before
    EXPECT_EQ(moreau.rows[i].rests_missed, 0.0);
    EXPECT_GT(moreau.rows[i].rest, 1e-6);
    EXPECT_LT(moreau.rows[i].rest, 0.1);
  }
  const PointAccuracy dopri5 = measure_accuracy(chattering_scene(), decades(TestedMethod::dopri5, 3, 10), once);
  EXPECT_GT(dopri5.rows[0].rest, 1e-6);
  EXPECT_NEAR(order_of(dopri5, &WorkPrecision::rest), 1.0, 0.3);
  for (const WorkPrecision& row : dopri5.rows) EXPECT_EQ(sum_of_faults(row), 0.0) << row.trial.setting;
}

}  // namespace
}  // namespace clatter::accuracy::accuracy_test
