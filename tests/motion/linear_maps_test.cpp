// Linear maps of four numbers: multipliers, fixed points, and the norm in which each eigenvector contracts by its own.

#include "motion/linear_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include "support/random.hpp"

namespace clatter::motion::linear_maps_test {
namespace {

TEST(LinearMaps, have_multipliers_in_the_order_of_their_modulus) {
  const auto found = multipliers_of({{{0.5, 0, 0, 0}, {0, 0, -2, 0}, {0, 2, 0, 0}, {0, 0, 0, -1}}});
  EXPECT_NEAR(std::abs(found[0] - std::complex<double>(0, 2)), 0, 1e-15);
  EXPECT_NEAR(std::abs(found[1] - std::complex<double>(0, -2)), 0, 1e-15);
  EXPECT_NEAR(found[2].real(), -1, 1e-15);
  EXPECT_NEAR(found[3].real(), 0.5, 1e-15);
  EXPECT_TRUE(std::isnan(multipliers_of({{{std::nan(""), 0, 0, 0}, {}, {}, {}}})[0].real()));
}

/// The map has the multipliers `large`, 5, 0.5 and 0.2, in coordinates of which none is one of theirs.
TEST(LinearMaps, have_no_multipliers_that_have_no_digits) {
  const auto of = [](double large, double power) {
    constexpr double turn[4][4] = {
        {1, 1, 1, 1}, {1, -1, 1, -1}, {1, 1, -1, -1}, {1, -1, -1, 1}};  // 4 times its inverse
    const std::array<double, 4> diagonal{large, 5, 0.5, 0.2};
    LooseJacobian entries{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k)
          entries[i][j] += std::ldexp(turn[i][k] * diagonal[k] * turn[k][j] / 4, -static_cast<int>(power));
    return known_of(multipliers_of(entries), power);
  };
  for (const double power : {0.0, 40.0}) {
    const double size = std::ldexp(1, static_cast<int>(power));
    const auto known = of(1e6, power);
    EXPECT_NEAR(std::abs(size * known[0] * size * known[1] * size * known[2] * size * known[3]), 5e5, 1e-2);
    const auto lost = of(1e17, power);
    EXPECT_NEAR(lost[0].real() * size, 1e17, 1e4);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(std::isnan(lost[i].real()) && std::isnan(lost[i].imag())) << i;
  }
  const auto two_large = known_of({1e18, -2e17, 3.0, 0.5}, 0);
  EXPECT_EQ(two_large[1], -2e17);
  EXPECT_TRUE(std::isnan(two_large[2].real()));
}

/// A map that contracts is applied until nothing changes any more.
TEST(LinearMaps, move_a_fixed_point_to_where_the_moved_map_leads) {
  const LooseJacobian map{{{0.4, -0.3, 0.1, 0.2}, {0.2, 0.3, -0.2, 0.1}, {0.1, 0.5, -0.3, 0.2}, {-0.4, 0.1, 0.2, 0.1}}};
  const std::array<double, 4> by_number{0.7, -1.3, 0.2, 2.1};
  std::array<double, 4> point{};
  for (int times = 0; times < 400; ++times) {
    std::array<double, 4> next = by_number;
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column) next[row] += map[row][column] * point[column];
    point = next;
  }
  const std::array<double, 4> change = change_of_fixed_point(map, by_number);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(change[i], point[i], 1e-14);
}

Four<double> mapped(const LooseJacobian& map, const Four<double>& change) {
  Four<double> result{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) result[row] += map[row][column] * change[column];
  return result;
}

/// A random map with entries of a few tenths.
LooseJacobian random_map(std::uint64_t index) {
  support::Random random(20931, index);
  LooseJacobian map;
  for (Four<double>& row : map)
    for (double& entry : row) entry = random.uniform(-0.6, 0.6);
  return map;
}

TEST(EigenNorm, shrinks_each_direction_by_the_modulus_of_a_multiplier) {
  for (std::uint64_t index = 0; index < 200; ++index) {
    const LooseJacobian map = random_map(index);
    const auto multipliers = multipliers_of(map);
    const auto norm = EigenNorm::of(map);
    ASSERT_TRUE(norm) << index;
    EXPECT_NEAR(norm->spectral_radius(), std::abs(multipliers[0]), 1e-14) << index;
    const auto directions = norm->directions();
    ASSERT_EQ(directions.size(), 4U) << index;
    for (const Four<double>& direction : directions) {
      EXPECT_NEAR(norm->size_of(direction), 1, 1e-9) << index;
      const double size = norm->size_of(mapped(map, direction));
      const auto is_its_modulus = [&](const auto& multiplier) { return std::abs(std::abs(multiplier) - size) < 1e-9; };
      EXPECT_TRUE(std::ranges::any_of(multipliers, is_its_modulus)) << index << ": " << size;
    }
  }
}

TEST(EigenNorm, no_change_grows_by_more_than_the_spectral_radius) {
  for (std::uint64_t index = 0; index < 200; ++index) {
    const LooseJacobian map = random_map(index);
    const auto norm = EigenNorm::of(map);
    ASSERT_TRUE(norm) << index;
    support::Random random(20932, index);
    const Four<double> change{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                              random.uniform(-1, 1)};
    EXPECT_LE(norm->size_of(mapped(map, change)), norm->spectral_radius() * norm->size_of(change) * (1 + 1e-9))
        << index;
  }
}

/// After a press a map knows two numbers. All that is left beside their directions it takes at once.
TEST(EigenNorm, knows_maps_of_less_than_four_numbers) {
  LooseJacobian map = random_map(7);
  map[2] = map[0], map[3] = map[1];
  for (Four<double>& row : map) row[2] = row[3] = 0;
  const auto norm = EigenNorm::of(map);
  ASSERT_TRUE(norm);
  EXPECT_EQ(norm->directions().size(), 2U);
  EXPECT_NEAR(norm->size_of({0, 0, 3, 4}), 5, 1e-12);
}

TEST(EigenNorm, is_none_of_a_map_that_shears) {
  EXPECT_FALSE(EigenNorm::of({{{0.5, 1, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 0.2, 0}, {0, 0, 0, 0.1}}}));
  EXPECT_FALSE(EigenNorm::of({{{std::nan(""), 0, 0, 0}, {}, {}, {}}}));
}

}  // namespace
}  // namespace clatter::motion::linear_maps_test
