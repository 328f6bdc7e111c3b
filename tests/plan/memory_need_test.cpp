#include "plan/memory_need.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "sweep/run.hpp"

namespace clatter::plan::memory_need_test {
namespace {

/// Bytes of all values of a dataset.
double bytes_of(const results::Dataset& dataset) {
  double bytes = 0;
  for (const results::Variable& variable : dataset.variables)
    bytes += std::visit(
        [](const auto& values) {
          return values.empty() ? 0.0 : static_cast<double>(values.size()) * static_cast<double>(sizeof(values[0]));
        },
        variable.values);
  return bytes;
}

std::size_t logged(const results::Dataset& dataset) {
  const auto tau = std::ranges::find(dataset.variables, "impact_tau", &results::Variable::name);
  return std::get<std::vector<double>>(tau->values).size();
}

sweep::Sweep small_sweep() {
  sweep::Sweep sweep;
  sweep.problem.stops = {-1, 1, 0.5, 0.5};
  sweep.dimensions = {{{Parameter("nu"), {0.8, 0.9, 1.0}}},
                      {{Parameter("h"), {0.1, 0.2}}, {Parameter("f"), {1.0, 1.5}}}};
  return sweep;
}

/// So many points on one axis, without observables.
sweep::Sweep line(std::size_t points) {
  sweep::Sweep sweep;
  sweep.problem.time.mode = steady::Mode::transient;
  sweep.dimensions = {{{Parameter("nu"), std::vector<double>(points, 0.5)}}};
  return sweep;
}

TEST(Memory, of_the_output_is_that_of_the_figure_with_its_coordinates) {
  sweep::Sweep sweep = small_sweep();
  EXPECT_EQ(memory_need(sweep).output, bytes_of(run(sweep, {}).dataset));
  sweep.problem.observe = {};
  sweep.problem.observe.extrema = true;
  sweep.problem.observe.harmonics = 3;
  sweep.problem.observe.impacts = true;
  sweep.problem.observe.trajectory = 10;
  sweep.problem.observe.period = true;
  sweep.problem.observe.stability = true;
  EXPECT_EQ(memory_need(sweep).output, bytes_of(run(sweep, {}).dataset));
}

TEST(Memory, of_an_impact_log_is_that_of_the_figure_if_the_impacts_are_known) {
  sweep::Sweep sweep = small_sweep();
  sweep.problem.observe = {};
  sweep.problem.observe.extrema = true;
  sweep.problem.observe.impact_log = true;
  const results::Dataset dataset = run(sweep, {}).dataset;
  EXPECT_EQ(memory_need(sweep, std::nullopt, 1, static_cast<double>(logged(dataset))).output, bytes_of(dataset));
}

TEST(Memory, of_a_run_holds_an_axis_and_each_result_once) {
  const double a_point = memory_need(line(2'000'000)).memory - memory_need(line(1'000'000)).memory;
  EXPECT_EQ(a_point / 1e6, 8 + (1 + 8 + 8) + 0.25);  // and two bits for the state of its chain
}

/// So many points over two axes.
sweep::Sweep square(std::size_t points) {
  sweep::Sweep sweep = line(points);
  sweep.dimensions.push_back({{Parameter("h"), sweep.dimensions[0][0].values}});
  return sweep;
}

TEST(Memory, of_many_points_stays_below_half_a_gibibyte_and_the_rest_is_in_files) {
  for (const std::size_t side : {1000UL, 4000UL, 10'000UL, 30'000UL}) {
    const sweep::Sweep sweep = square(side);
    const MemoryNeed need = memory_need(sweep, std::nullopt, 2);
    const auto points = static_cast<double>(side * side);
    EXPECT_LT(need.memory, points < 1e9 ? 512.0 * 1024 * 1024 : 1e9) << side;
    EXPECT_LT(need.merging, 512.0 * 1024 * 1024) << side;
    EXPECT_EQ(need.in_files, side < 5000 ? 0.0 : points * 17) << side;
    EXPECT_GE(need.disk(), need.output + need.in_files + points * 17) << side;
  }
}

TEST(Memory, of_a_huge_sweep_is_known_without_running_it) {
  sweep::Sweep sweep;
  const std::vector<double> values(1000, 0.5);
  sweep.dimensions = {{{Parameter("nu"), values}}, {{Parameter("h"), values}}, {{Parameter("f"), values}}};
  sweep.problem.observe.trajectory = 1000;
  EXPECT_EQ(memory_need(sweep).output, 1e9 * (25 + 3 * 8000) + 3 * 8000);
}

TEST(Memory, of_samples_counts_for_each_thread) {
  sweep::Sweep sweep = line(1);
  sweep.problem.observe = {};
  sweep.problem.observe.harmonics = 3;
  sweep.problem.observe.harmonics_method = observables::HarmonicsMethod::fft;
  sweep.problem.observe.harmonics_samples = 1 << 20;
  for (const bool is_loose : {false, true}) {
    sweep.problem.observe.loose_harmonics = is_loose;
    const double four = memory_need(sweep, std::nullopt, 4).memory, two = memory_need(sweep, std::nullopt, 2).memory;
    // two rows of samples and the sums of each, and of a loose mass two rows more
    EXPECT_NEAR(four - two, 2.0 * (is_loose ? 6 : 4) * 8 * (1 << 20), 1e6) << is_loose;
  }
}

TEST(Memory, of_followed_chains_counts_one_that_is_saved) {
  sweep::Sweep sweep = line(1'000'000);
  sweep.problem.observe.extrema = true;
  const double apart = memory_need(sweep).memory;
  sweep.follow = 0;
  // 49 bytes of results a point once more, instead of what is held while the file is written: 1 MiB of pages, 2 MiB of
  // values, and 2.5 MiB to deflate them
  EXPECT_NEAR(memory_need(sweep).memory - apart, 1e6 * 49 - 5.5 * 1024 * 1024, 1e6);
}

TEST(Memory, of_a_log_is_estimated_from_a_few_points) {
  sweep::Sweep sweep;  // to and fro between the stops at speeds from 1 to 2, without loss
  sweep.problem.stops = {-0.1, 0.1, 1, 1};
  sweep.problem.time.mode = steady::Mode::transient;
  sweep.problem.observe = {};
  sweep.problem.observe.impact_log = true;
  std::vector<double> speeds;
  for (int i = 0; i < 1000; ++i) speeds.push_back(1 + i / 1000.0);
  sweep.dimensions = {{{Parameter("v0"), speeds}}};
  for (const double duration : {1.0, 100.0, 700.0}) {  // shorter and longer than the runs for the estimate
    sweep.problem.time.duration = duration;
    const auto impacts = static_cast<double>(logged(run(sweep, {}).dataset));
    EXPECT_NEAR(expected_impacts(sweep, std::nullopt), impacts, 0.02 * impacts) << duration;
    EXPECT_NEAR(expected_impacts(sweep, results::Shard{1, 4}), impacts / 4, 0.02 * impacts) << duration;
  }
}

TEST(Memory, of_a_log_of_steady_motion_is_that_of_the_observed_time) {
  sweep::Sweep sweep = small_sweep();
  sweep.problem.observe = {};
  sweep.problem.observe.impact_log = true;
  EXPECT_EQ(expected_impacts(sweep, std::nullopt), static_cast<double>(logged(run(sweep, {}).dataset)));
}

TEST(Memory, of_a_merge_grows_with_the_axes_and_not_with_the_points) {
  EXPECT_EQ(merge_bytes(square(20'000), 7, 0) - merge_bytes(square(10'000), 7, 0), 2 * 10'000 * 8);
}

}  // namespace
}  // namespace clatter::plan::memory_need_test
