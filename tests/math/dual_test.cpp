#include "math/dual.hpp"

#include <gtest/gtest.h>

namespace clatter {
namespace {

using First = Dual<double, 2>;
using Second = Dual<First, 2>;

/// A function of x and y that uses every operation, with its derivatives by hand.
template <class Number>
Number of(const Number& x, const Number& y) {
  return sin(x * y) / (1 + exp(-x)) - sqrt(y) * cos(x) + expm1(x) * atan(y) - abs(-y);
}

TEST(Dual, has_the_derivatives_of_textbooks) {
  const double x = 0.7, y = 1.3, e = std::exp(-x), s = 1 / (1 + e);
  const First f = of(First(x, 0), First(y, 1));
  EXPECT_NEAR(
      f.slope[0],
      y * std::cos(x * y) * s + std::sin(x * y) * e * s * s + std::sqrt(y) * std::sin(x) + std::exp(x) * std::atan(y),
      1e-15);
  EXPECT_NEAR(f.slope[1], x * std::cos(x * y) * s - std::cos(x) / (2 * std::sqrt(y)) + std::expm1(x) / (1 + y * y) - 1,
              1e-15);
}

TEST(Dual, of_duals_has_second_derivatives_that_agree_in_either_order) {
  const Second x(First(0.7, 0), 0), y(First(1.3, 1), 1);
  const Second f = of(x, y);
  EXPECT_NEAR(f.slope[0].slope[1], f.slope[1].slope[0], 1e-15);
  EXPECT_EQ(f.value.slope[0], f.slope[0].value);
  const double step = 1e-5;  // truncation 1e-10, rounding 1e-11
  const double ahead = of(First(0.7 + step, 0), First(1.3, 1)).slope[0],
               behind = of(First(0.7 - step, 0), First(1.3, 1)).slope[0];
  EXPECT_NEAR(f.slope[0].slope[0], (ahead - behind) / (2 * step), 1e-9);
}

TEST(Dual, is_compared_by_its_value) {
  EXPECT_TRUE(First(1.0, 0) < First(2.0, 1) && First(1.0, 0) == First(1.0, 1) && First(3.0) > 2);
}

}  // namespace
}  // namespace clatter
