#include "certificates/growth.hpp"

#include <gtest/gtest.h>

namespace clatter::certificates::growth_test {
namespace {

TEST(Growth, rounding_that_enters_after_a_contraction_is_stretched_by_the_rest_alone) {
  Growth<2> growth;
  growth.pass({0.01, 0, 0, 0.01}, 1.0);
  growth.pass({100, 0, 0, 10}, 1.0);
  EXPECT_DOUBLE_EQ(growth.derivative()[0], 1.0);
  EXPECT_DOUBLE_EQ(growth.derivative()[3], 0.1);
  EXPECT_DOUBLE_EQ(growth.rounding()[0], 100.0);
  EXPECT_DOUBLE_EQ(growth.rounding()[1], 10.0);
}

TEST(Growth, errors_turn_with_the_motion) {
  Growth<2> growth;
  growth.pass({0, 1, -1, 0}, 3.0);
  growth.pass({0, 1, -1, 0}, 4.0);
  growth.pass({2, 0, 0, 1}, 0.0);
  EXPECT_DOUBLE_EQ(growth.derivative()[0], -2.0);
  EXPECT_DOUBLE_EQ(growth.rounding()[0], 10.0);  // 2 (3^2 + 4^2)^(1/2)
  EXPECT_DOUBLE_EQ(growth.rounding()[1], 5.0);
}

TEST(Growth, a_rest_forgets_all) {
  Growth<2> growth;
  growth.pass({3, 1, 2, 5}, 1.0);
  growth.pass({0, 0, 0, 0}, 0.5);
  EXPECT_EQ(growth.rounding()[0], 0.0);
  growth.pass({1, 0, 0, 1}, 0.0);
  EXPECT_EQ(growth.rounding()[0], 0.5);
}

}  // namespace
}  // namespace clatter::certificates::growth_test
