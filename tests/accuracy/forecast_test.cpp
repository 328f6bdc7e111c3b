#include "accuracy/forecast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "accuracy/timing.hpp"

namespace clatter::accuracy::forecast_test {
namespace {

/// The times of the trials of a scene, in seconds: the exact method takes `exact`; other methods and observables cost
/// more by the ratios of three measured accuracy runs, times a factor.
struct Costs {
  double exact = 1e-4, dopri5 = 1, moreau = 1, observed = 1;

  [[nodiscard]] double first(const Trial& trial) const {
    switch (trial.method) {
      case TestedMethod::dopri5:
        return exact * 20 * dopri5 * std::pow(1e-3 / trial.setting, 0.17);
      case TestedMethod::moreau:
        return exact * (4 + moreau / trial.setting);
      case TestedMethod::harmonics_fft:
        return 5e-4 + 5e-8 * trial.setting;
      default:
        return exact;
    }
  }
  [[nodiscard]] double silent(const Trial& trial) const {
    if (trial.method == TestedMethod::moreau) return 0.02 * observed * first(trial);
    return (trial.method == TestedMethod::dopri5 ? 0.12 * observed : 0.8) * first(trial);
  }
};

constexpr int rounds = 9;

/// The end of each step of an accuracy run, and the forecast then.
struct RunRecord {
  std::vector<double> ends;
  std::vector<std::optional<double>> told;
};

RunRecord record_of(const Costs& costs) {
  const std::vector<Trial> trials = trials_of(steady::Mode::steady, lanes::InstructionSet::avx2);
  Forecast forecast(trials, rounds);
  RunRecord record;
  double now = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    now += costs.first(trials[i]);
    forecast.ran(i, costs.first(trials[i]));
    record.ends.push_back(now), record.told.push_back(forecast.seconds_left());
  }
  for (int round = -1; round < rounds; ++round)
    for (std::size_t i = 0; i < trials.size(); ++i) {
      now += Timing::lasts(costs.silent(trials[i]), round);
      forecast.measured(i, round, costs.silent(trials[i]));
      record.ends.push_back(now), record.told.push_back(forecast.seconds_left());
    }
  return record;
}

TEST(Forecast, is_right_within_a_factor_of_three_once_the_dear_methods_have_begun) {
  for (const double exact : {1e-5, 1e-4, 1e-3, 1e-2})
    for (const double dopri5 : {0.5, 2.0})
      for (const double moreau : {0.1, 1.0, 3.0})
        for (const double observed : {0.6, 1.5}) {
          const RunRecord record = record_of({exact, dopri5, moreau, observed});
          bool is_told = false;
          for (std::size_t i = 0; i + 1 < record.ends.size(); ++i) {
            const double truth = record.ends.back() - record.ends[i];
            ASSERT_TRUE(record.told[i] || !is_told);  // once there is a forecast, there always is
            is_told = record.told[i].has_value();
            if (!is_told || record.ends[i] < 2) continue;
            const auto where = testing::Message()
                               << exact << ' ' << dopri5 << ' ' << moreau << ' ' << observed << ": step " << i << ", "
                               << record.ends[i] << " of " << record.ends.back() << " s";
            EXPECT_LE(*record.told[i], 3 * truth) << where;
            EXPECT_GE(*record.told[i], truth / 3) << where;
          }
          EXPECT_TRUE(is_told);
        }
}

TEST(Forecast, of_measured_trials_is_exact) {
  const RunRecord record = record_of({});
  const std::size_t all = trials_of(steady::Mode::steady, lanes::InstructionSet::avx2).size();
  for (std::size_t i = 2 * all; i < record.ends.size(); ++i)
    EXPECT_NEAR(*record.told[i], record.ends.back() - record.ends[i], 1e-9) << i;
  EXPECT_EQ(*record.told.back(), 0.0);
}

TEST(Forecast, tells_nothing_before_a_trial_of_every_dear_method_has_run) {
  const std::vector<Trial> trials = trials_of(steady::Mode::transient, lanes::InstructionSet::scalar);
  Forecast forecast(trials, rounds);
  for (std::size_t i = 0; trials[i].method != TestedMethod::moreau; ++i) {
    EXPECT_FALSE(forecast.seconds_left());
    forecast.ran(i, 1.0);
  }
  EXPECT_FALSE(forecast.seconds_left());
}

TEST(Forecast, a_trial_that_never_runs_takes_no_time) {
  Forecast forecast({{TestedMethod::exact, 0.0}, {TestedMethod::steady, 1e-3}}, rounds);
  forecast.ran(0, 1.0), forecast.ran(1, 0.0);
  forecast.measured(0, -1, 0.5), forecast.measured(1, -1, 0.0);
  EXPECT_NEAR(*forecast.seconds_left(), rounds * 0.5, 1e-12);
}

}  // namespace
}  // namespace clatter::accuracy::forecast_test
