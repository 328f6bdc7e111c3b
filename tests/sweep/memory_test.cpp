#include "sweep/memory.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "sweep/run.hpp"

namespace clatter {
namespace {

/// Bytes of all results of a figure; coordinates, which are named by their only dimension, are no results.
double bytes_of(const Figure& figure) {
  double bytes = 0;
  for (const Variable& variable : figure.variables) {
    if (variable.dimensions.size() == 1 && variable.dimensions.front() == variable.name) continue;
    bytes += std::visit(
        [](const auto& values) {
          return static_cast<double>(values.size()) * static_cast<double>(sizeof(values.front()));
        },
        variable.values);
  }
  return bytes;
}

TEST(Memory, is_that_of_the_figure) {
  Sweep sweep;
  sweep.scene.stops = {-1, 1, 0.5, 0.5};
  sweep.dimensions = {{{Parameter::nu, {0.8, 0.9, 1.0}}}, {{Parameter::h, {0.1, 0.2}}}};
  EXPECT_EQ(result_bytes(sweep), 6 * 25);
  sweep.scene.observe = {.extrema = true, .harmonics = 3, .impacts = true, .trajectory = 10, .period = true};
  EXPECT_EQ(result_bytes(sweep), bytes_of(run(sweep, {}).figure));
}

TEST(Memory, of_a_run_is_that_of_the_results_and_the_largest_variable) {
  Sweep sweep;
  sweep.dimensions = {{{Parameter::nu, {0.8, 0.9, 1.0}}}};
  EXPECT_EQ(run_bytes(sweep), result_bytes(sweep) + 3 * 8);
  sweep.scene.observe = {.extrema = true, .harmonics = 3, .trajectory = 10};
  EXPECT_EQ(run_bytes(sweep), result_bytes(sweep) + 3 * 8 * 10);
}

TEST(Memory, of_a_huge_sweep_is_known_without_running_it) {
  Sweep sweep;
  const std::vector<double> values(1000, 0.5);
  sweep.dimensions = {{{Parameter::nu, values}}, {{Parameter::h, values}}, {{Parameter::f, values}}};
  sweep.scene.observe.trajectory = 1000;
  EXPECT_EQ(result_bytes(sweep), 1e9 * (25 + 3 * 8000));
}

}  // namespace
}  // namespace clatter
