#include "accuracy/cheapest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace clatter::accuracy::cheapest_test {
namespace {

using lanes::InstructionSet;

WorkPrecision row(TestedMethod method, double setting, double error, double ns,
                  InstructionSet arch = InstructionSet::scalar) {
  WorkPrecision row;
  row.trial = {method, setting, arch};
  row.status = steady::Status::transient;
  row.extrema = error, row.ns_per_period = ns;
  row.missed = row.extra = row.rests_missed = 0;
  return row;
}

TEST(Error, is_the_largest_of_those_that_a_row_has) {
  WorkPrecision one = row(TestedMethod::exact, 0, 1e-9, 10);
  EXPECT_EQ(error_of(one), 1e-9);
  one.contact_speed = 1e-7, one.rest = 1e-8;
  EXPECT_EQ(error_of(one), 1e-7);
  one.harmonics = 1.0;  // of the steady motion, not of the run
  EXPECT_EQ(error_of(one), 1e-7);
  one.status = steady::Status::event_budget;
  EXPECT_TRUE(std::isnan(error_of(one)));
  EXPECT_TRUE(std::isnan(error_of(WorkPrecision{})));
}

TEST(Error, of_a_row_with_other_impacts_does_not_exist) {
  for (double WorkPrecision::*const count :
       {&WorkPrecision::missed, &WorkPrecision::extra, &WorkPrecision::rests_missed}) {
    WorkPrecision one = row(TestedMethod::dopri5, 1e-3, 1e-9, 10);
    one.*count = 1;
    EXPECT_TRUE(std::isnan(error_of(one)));
    EXPECT_EQ(misses_from(std::vector{one}, TestedMethod::dopri5), 1e-3);
  }
}

TEST(Cheapest, is_the_setting_that_reaches_an_error_in_the_least_time) {
  const std::vector<WorkPrecision> rows{
      row(TestedMethod::exact, NAN, 1e-14, 50), row(TestedMethod::exact, NAN, 1e-13, 5, InstructionSet::avx2),
      row(TestedMethod::dopri5, 1e-3, 1e-2, 100), row(TestedMethod::dopri5, 1e-5, 1e-5, 300),
      row(TestedMethod::dopri5, 1e-7, 1e-7, 200)};  // quicker than a looser one
  EXPECT_EQ(cheapest(rows, TestedMethod::dopri5, false, 1e-2), &rows[2]);
  EXPECT_EQ(cheapest(rows, TestedMethod::dopri5, false, 9e-3), &rows[4]);
  EXPECT_EQ(cheapest(rows, TestedMethod::dopri5, false, 1e-8), nullptr);
  EXPECT_EQ(cheapest(rows, TestedMethod::dopri5, true, 1), nullptr);
  EXPECT_EQ(cheapest(rows, TestedMethod::exact, false, 1e-2), &rows[0]);
  EXPECT_EQ(cheapest(rows, TestedMethod::exact, true, 1e-13), &rows[1]);
  EXPECT_EQ(cheapest(rows, TestedMethod::exact, true, 1e-14), nullptr);
}

TEST(Misses, begin_at_the_finest_setting_that_has_any) {
  std::vector<WorkPrecision> rows{row(TestedMethod::moreau, 1e-1, 1, 1), row(TestedMethod::moreau, 1e-2, 1, 1),
                                  row(TestedMethod::moreau, 1e-3, 1, 1)};
  EXPECT_FALSE(misses_from(rows, TestedMethod::moreau));
  rows[0].missed = rows[1].extra = 2;
  EXPECT_EQ(misses_from(rows, TestedMethod::moreau), 1e-2);
  EXPECT_FALSE(misses_from(rows, TestedMethod::dopri5));
}

}  // namespace
}  // namespace clatter::accuracy::cheapest_test
