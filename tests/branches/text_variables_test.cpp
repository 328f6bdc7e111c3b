#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "branches/branch_dataset.hpp"
#include "results/dataset.hpp"
#include "sweep/run.hpp"

namespace clatter::branches::text_variables_test {
namespace {

void add_texts(const results::Dataset& dataset, std::set<std::string>& names) {
  for (const results::Variable& variable : dataset.variables)
    if (std::holds_alternative<std::vector<std::string>>(variable.values)) names.insert(variable.name);
}

/// Readers refuse a file in which it is otherwise.
TEST(TextVariables, are_those_that_runs_and_branches_write) {
  sweep::Sweep sweep;
  sweep.problem.oscillator = {0.1, -1.0, 1.0, 0.0};
  sweep.problem.stops = {-1.0, 1.0, 0.7, 0.7};
  sweep.problem.observe.word = sweep.problem.observe.attractor = true;
  std::set<std::string> written;
  add_texts(sweep::run(sweep, {.threads = 1}).dataset, written);
  add_texts(branch_dataset({}, {}), written);
  EXPECT_EQ(written, std::set<std::string>(results::text_variables.begin(), results::text_variables.end()));
}

}  // namespace
}  // namespace clatter::branches::text_variables_test
