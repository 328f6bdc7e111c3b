// Extrema of a displacement whose bounds are lost.
#include <gtest/gtest.h>

#include <array>

#include "verify/extrema.hpp"

namespace verify::extrema_test {
namespace {

TEST(Extrema, are_undecided_if_a_place_is_no_number) {
  const Ball unknown = Ball(0) / Ball(0);
  for (const int sign : {-1, 1}) {
    EXPECT_TRUE((extremum({}, std::array{Ball(1), Ball(1)}, sign) - Ball(1)).is_zero());
    EXPECT_THROW((void)extremum({}, std::array{Ball(1), unknown}, sign), Undecided);
    EXPECT_THROW((void)extremum({}, std::array{unknown, Ball(1)}, sign), Undecided);
  }
}

}  // namespace
}  // namespace verify::extrema_test
