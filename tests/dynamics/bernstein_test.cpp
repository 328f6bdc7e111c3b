#include "dynamics/bernstein.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clatter {
namespace {

/// Value of a Bernstein polynomial (de Casteljau).
double value(Bernstein<double> c, double u) {
  for (std::size_t n = c.size() - 1; n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) c[i] += u * (c[i + 1] - c[i]);
  return c[0];
}

/// Bernstein coefficients of scale * prod (root_i - u), of degree 6.
Bernstein<double> with_roots(const std::array<double, 6>& roots) {
  std::array<double, 7> powers{1.0};
  for (std::size_t n = 0; n < roots.size(); ++n)
    for (std::size_t i = n + 1; i + 1 > 0; --i) {
      powers[i] = powers[i] * roots[n] - (i > 0 ? powers[i - 1] : 0.0);
      if (i == 0) break;
    }
  const auto choose = [](std::size_t n, std::size_t k) {
    double product = 1.0;
    for (std::size_t i = 0; i < k; ++i) product *= static_cast<double>(n - i) / static_cast<double>(i + 1);
    return product;
  };
  Bernstein<double> c{};
  for (std::size_t j = 0; j < c.size(); ++j)
    for (std::size_t i = 0; i <= j; ++i) c[j] += choose(j, i) / choose(6, i) * powers[i];
  return c;
}

TEST(Bernstein, hermite_error_is_the_sixth_derivative_over_14400_at_most) {
  // y = cos: |y^(6)| <= 1; the bound holds everywhere and is nearly reached, so it is neither wrong nor slack
  for (double step : {0.1, 0.5, 1.6}) {
    for (double from : {0.0, 1.0, 2.5}) {
      const double to = from + step;
      const auto c = hermite<double>(step, std::cos(to) - std::cos(from), {-std::sin(from), -std::sin(to)},
                                     {-std::cos(from), -std::cos(to)});
      double worst = 0.0;
      for (double u = 0.0; u <= 1.0; u += 1.0 / 128) {
        const double difference = std::abs(std::cos(from + u * step) - std::cos(from) - value(c, u));
        EXPECT_LE(difference, hermite_error(std::pow(step, 6)) * middle_function(u) + 4e-16);
        worst = std::max(worst, difference);
      }
      if (from == 0.0 && step == 0.5) {
        EXPECT_GT(worst, 0.9 * hermite_error(std::cos(0.5) * std::pow(step, 6)) * middle_function(0.5));
      }
    }
  }
}

TEST(Bernstein, finds_the_first_of_several_roots) {
  const auto c = with_roots({0.7, 0.2, 0.9, 2.0, 3.0, 4.0});
  ASSERT_GT(c[0], 0.0);
  const auto root = FirstRoot<double>::of(c);
  ASSERT_TRUE(root);
  EXPECT_NEAR(*root, 0.2, 1e-13);  // coefficients round to 1e-16 of up to 15, the slope there is 13
}

TEST(Bernstein, tells_two_close_roots_from_none) {
  const double middle = 0.437, apart = 1e-5;
  const auto crossing = FirstRoot<double>::of(with_roots({middle - apart, middle + apart, 2.0, 3.0, 4.0, 5.0}));
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(*crossing, middle - apart, 1e-9);  // a coefficient's rounding over the slope 2e-5 * 100
  auto lifted = with_roots({middle, middle, 2.0, 3.0, 4.0, 5.0});
  for (double& coefficient : lifted) coefficient += 1e-9;  // no root, although coefficients are negative
  EXPECT_LT(*std::min_element(lifted.begin(), lifted.end()), 0.0);
  EXPECT_FALSE(FirstRoot<double>::of(lifted));
}

TEST(Bernstein, a_root_at_the_beginning_does_not_count) {
  EXPECT_FALSE(FirstRoot<double>::of({0, 1, 1, 1, 1, 1, 1}));
  EXPECT_FALSE(FirstRoot<double>::of({0, 0, 0, 1, 1, 1, 1}));
  const auto later = FirstRoot<double>::of({0, 1, 1, 1, 1, 1, -1});
  ASSERT_TRUE(later);
  EXPECT_NEAR(value({0, 1, 1, 1, 1, 1, -1}, *later), 0.0, 1e-15);
}

TEST(Bernstein, a_tiny_root_keeps_its_relative_accuracy) {
  // u (w - u) of degree 6, as a bounce far below rounding of the step gives it
  for (double w : {1e-3, 1e-9, 1e-15}) {
    Bernstein<double> c{};
    for (std::size_t i = 0; i < c.size(); ++i) {
      const auto j = static_cast<double>(i);
      c[i] = w * j / 6 - j * (j - 1) / 30;
    }
    const auto root = FirstRoot<double>::of(c);
    ASSERT_TRUE(root);
    EXPECT_NEAR(*root / w, 1.0, 1e-15);
  }
}

TEST(Bernstein, signs_without_change_have_no_root) {
  EXPECT_FALSE(FirstRoot<double>::of({1, 2, 3, 4, 3, 2, 1}));
  EXPECT_FALSE(FirstRoot<double>::of({0, 0, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace clatter
