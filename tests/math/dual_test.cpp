#include "math/dual.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace clatter::dual_test {
namespace {

using First = Dual<double, 2>;
using Second = Dual<First, 2>;

/// A function of x and y that uses every operation, with its derivatives by hand.
template <class Number>
Number of(const Number& x, const Number& y) {
  return sin(x * y) / (1 + exp(-x)) - sqrt(y) * cos(x) + expm1(x) * atan(y) - abs(-y);
}

/// The length, the angle and the square sum of a vector.
template <class Number>
std::array<Number, 3> polar(const Number& x, const Number& y) {
  return {hypot(x, y), atan2(y, x), fma(x, x, Number(y * y))};
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

TEST(Dual, has_the_derivatives_of_polar_coordinates_in_each_quadrant) {
  for (const auto& [x, y] : {std::pair(0.7, 1.3), {-0.7, 1.3}, {-0.7, -1.3}, {0.7, -1.3}, {0.0, 1.3}, {-0.7, 0.0}}) {
    const auto [length, angle, square] = polar(First(x, 0), First(y, 1));
    EXPECT_EQ(length.value, std::hypot(x, y));
    EXPECT_EQ(angle.value, std::atan2(y, x));
    EXPECT_NEAR(length.slope[0], std::cos(angle.value), 1e-15);
    EXPECT_NEAR(length.slope[1], std::sin(angle.value), 1e-15);
    EXPECT_NEAR(angle.slope[0], -std::sin(angle.value) / length.value, 1e-15);
    EXPECT_NEAR(angle.slope[1], std::cos(angle.value) / length.value, 1e-15);
    EXPECT_EQ(square.slope[0], 2 * x);
    EXPECT_EQ(square.slope[1], 2 * y);
  }
  const auto second = polar(Second(First(0.7, 0), 0), Second(First(-1.3, 1), 1));
  const double r = std::hypot(0.7, 1.3), s = -1.3 / r, c = 0.7 / r;  // r'' = s^2/r, -s c/r; angle'' = 2 s c/r^2, ...
  EXPECT_NEAR(second[0].slope[0].slope[0], s * s / r, 1e-15);
  EXPECT_NEAR(second[0].slope[0].slope[1], -s * c / r, 1e-15);
  EXPECT_NEAR(second[1].slope[0].slope[0], 2 * s * c / (r * r), 1e-15);
  EXPECT_NEAR(second[1].slope[1].slope[0], (s * s - c * c) / (r * r), 1e-15);
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
}  // namespace clatter::dual_test
