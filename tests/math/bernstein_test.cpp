#include "math/bernstein.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random.hpp"

namespace clatter::bernstein_test {
inline namespace math {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();

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
      const auto c = hermite(HermiteData<double>::over(
          step, {0.0, -std::sin(from), -std::cos(from), std::cos(to) - std::cos(from), -std::sin(to), -std::cos(to)}));
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
  EXPECT_NEAR(*root, 0.2, 1e-13);  // coefficients up to 15 round to 1e-16 of themselves; the slope at the root is 13
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
  // u (w - u) as degree 6, as after a bounce far below the rounding of the step
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

TEST(Bernstein, a_touch_without_crossing_is_no_root_and_a_hair_beyond_it_is) {
  const Bernstein<double> touching{15, 5, -1, -3, -1, 5, 15};  // 60 (u - 1/2)^2, exact when halved
  EXPECT_FALSE(FirstRoot<double>::of(touching));
  for (const double beyond : {0x1p-8, 0x1p-16, 0x1p-24}) {  // roots at 1/2 -+ beyond
    Bernstein<double> c = touching;
    for (double& coefficient : c) coefficient -= 60 * beyond * beyond;
    const auto root = FirstRoot<double>::of(c);
    ASSERT_TRUE(root) << beyond;
    // a rounding of coefficients up to 15, over the slope 120 beyond; the last place holds 1/2 -+ beyond to half an ulp
    EXPECT_NEAR(*root, 0.5 - beyond, 15 * ulp / (120 * beyond) + ulp) << beyond;
  }
}

/// A polynomial of degree 5 (or less) by its powers, with its derivative.
struct Powers {
  std::array<double, 6> a{};

  static Powers any(support::Random& random, std::size_t degree) {
    Powers p;
    for (std::size_t k = 0; k <= degree; ++k) p.a[k] = random.uniform(-1, 1);
    return p;
  }
  [[nodiscard]] double at(double s) const {
    double sum = 0;
    for (std::size_t k = a.size(); k-- > 0;) sum = sum * s + a[k];
    return sum;
  }
  [[nodiscard]] double slope(double s) const {
    double sum = 0;
    for (std::size_t k = a.size(); k-- > 1;) sum = sum * s + static_cast<double>(k) * a[k];
    return sum;
  }
  /// Bound, on a step, of the value, the slope times the step, and their terms.
  [[nodiscard]] double size(double step) const {
    double sum = 0, power = 1;
    for (const double coefficient : a) sum += std::abs(coefficient) * power, power *= step;
    return sum;
  }
};

/// Largest difference, over a step, of a Bernstein polynomial from one given by powers, relative to the latter's size.
double difference(const Bernstein<double>& c, const Powers& p, double step) {
  double worst = 0;
  for (int i = 0; i <= 64; ++i) worst = std::max(worst, std::abs(value_at(c, i / 64.0) - p.at(step * i / 64)));
  return worst / p.size(step);
}

TEST(Bernstein, quintic_gives_back_any_polynomial_of_degree_five) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    support::Random random(21, i);
    const double step = random.logarithmic(1e-3, 3);
    const Powers p = Powers::any(random, 5);
    const auto c =
        quintic(step, {p.at(0), p.slope(0)}, {p.at(step), p.slope(step)}, {p.at(step / 3), p.at(2 * step / 3)});
    // two coefficients sum values with weights of up to 243/40 * 2/3 and, in all, 366/40 of either sign: 10 roundings
    EXPECT_LE(difference(c, p, step), 16 * ulp) << i;
    EXPECT_EQ(c.front(), p.at(0));
    EXPECT_EQ(c.back(), p.at(step));
  }
}

TEST(Bernstein, quintic_does_not_give_back_a_polynomial_of_degree_six) {
  const auto power = [](double u) { return u * u * u * u * u * u; };
  const auto c = quintic(1.0, {0, 0}, {1, 6}, {power(1.0 / 3), power(2.0 / 3)});
  // their difference has a simple zero at each given value, and a double one if the slope is given, too
  const auto error = [](double u) { return u * u * (u - 1.0 / 3) * (u - 2.0 / 3) * (u - 1) * (u - 1); };
  for (const double u : {0.2, 0.5, 0.8}) EXPECT_NEAR(power(u) - value_at(c, u), error(u), 16 * ulp);
}

TEST(Bernstein, cubic_gives_back_any_polynomial_of_degree_three) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    support::Random random(22, i);
    const double step = random.logarithmic(1e-3, 3);
    const Powers p = Powers::any(random, 3);
    const auto c = cubic(step, {p.at(0), p.slope(0)}, {p.at(step), p.slope(step)});
    EXPECT_LE(difference(c, p, step), 8 * ulp) << i;  // sums of a few values with weights below 1
    EXPECT_EQ(c.front(), p.at(0));
    EXPECT_EQ(c.back(), p.at(step));
  }
}

TEST(Bernstein, value_at_the_ends_is_the_first_and_the_last_coefficient) {
  const Bernstein<double> c{0.3, -7, 2, 1e9, 5, -1, 0.7};
  EXPECT_EQ(value_at(c, 0.0), 0.3);
  EXPECT_NEAR(value_at(c, 1.0), 0.7, 2 * ulp * 1e9);  // a + (b - a) is b to a rounding of a
}

TEST(Bernstein, split_off_gives_both_parts) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    support::Random random(23, i);
    Bernstein<double> c;
    for (double& coefficient : c) coefficient = random.uniform(-1, 1);
    const double u = random.uniform(0, 1);
    Bernstein<double> after = c;
    const Bernstein<double> before = split_off(after, u);
    EXPECT_EQ(before.front(), c.front());
    EXPECT_EQ(after.back(), c.back());
    EXPECT_EQ(before.back(), after.front());
    EXPECT_EQ(before.back(), value_at(c, u));
    for (int k = 0; k <= 16; ++k) {  // convex sums of coefficients below 1: a rounding for each of six levels, twice
      EXPECT_NEAR(value_at(before, k / 16.0), value_at(c, u * k / 16), 12 * ulp) << i;
      EXPECT_NEAR(value_at(after, k / 16.0), value_at(c, u + (1 - u) * k / 16), 12 * ulp) << i;
    }
  }
}

TEST(Bernstein, split_off_at_an_end_leaves_a_point) {
  const Bernstein<double> c{1, 4, -2, 8, 0, 3, 5};
  Bernstein<double> all = c;
  for (const double y : split_off(all, 0.0)) EXPECT_EQ(y, 1.0);
  EXPECT_EQ(all, c);
  EXPECT_EQ(split_off(all, 1.0), c);  // whole numbers: no rounding
  for (const double y : all) EXPECT_EQ(y, 5.0);
}

}  // namespace
}  // namespace math
}  // namespace clatter::bernstein_test
