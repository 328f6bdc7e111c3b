#include "scene/stops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/fifty_digits.hpp"

namespace clatter::stops_test {
inline namespace scene {
namespace {

template <class Number>
class Restitutions : public testing::Test {};
using Numbers = testing::Types<double, FiftyDigits>;
TYPED_TEST_SUITE(Restitutions, Numbers);

TYPED_TEST(Restitutions, reverse_the_velocity_and_keep_the_share_R_of_it) {
  const Restitution<TypeParam> law{TypeParam(7) / 8};
  for (const double before : {-3.0, -1e-300, 0.0, 0.5, 1e300}) {
    const TypeParam v(before);
    EXPECT_EQ(law.after(v), -(TypeParam(7) / 8) * v);
    EXPECT_EQ(law.jump(v), -(TypeParam(15) / 8) * v);  // 7/8 and 15/8 are exact
    EXPECT_EQ(law.after(v), law.derivative(v) * v);    // it is linear
  }
}

TEST(Restitution, that_takes_all_speed_leaves_no_negative_zero) {
  const Restitution<double> law{0.0};
  for (const double before : {-2.0, 0.0, 2.0}) EXPECT_FALSE(std::signbit(law.after(before))) << before;
}

TEST(Restitution, lets_a_value_that_is_no_number_through) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(Restitution<double>{nan}.after(1.0)));
  EXPECT_TRUE(std::isnan(Restitution<double>{0.5}.after(nan)));
}

}  // namespace
}  // namespace scene
}  // namespace clatter::stops_test
