#include "observables/harmonics/fourier_transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/random.hpp"

namespace clatter::observables::fourier_transform_test {
namespace {

/// N samples of 0.25 + 3 cos(5 tau + 0.7) over a period.
std::vector<double> cosine(std::size_t n) {
  std::vector<double> samples;
  for (std::size_t i = 0; i < n; ++i)
    samples.push_back(
        0.25 + 3 * std::cos(2 * std::numbers::pi * static_cast<double>(5 * i % n) / static_cast<double>(n) + 0.7));
  return samples;
}

TEST(FourierTransform, finds_a_sum_of_cosines) {
  const std::size_t n = 64;
  const FourierTransform transform(n);
  const auto workspace = transform.workspace();
  for (const auto& row : transform.samples(*workspace)) std::ranges::copy(cosine(n), row.begin());
  for (const auto& c : transform.transform(*workspace)) {
    ASSERT_EQ(c.size(), n / 2 + 1);
    EXPECT_NEAR(c[0].real() / n, 0.25, 1e-15);
    EXPECT_NEAR(2 * std::abs(c[5]) / n, 3.0, 2e-15);
    EXPECT_NEAR(std::arg(c[5]), 0.7, 1e-15);
    EXPECT_LT(std::abs(c[4]) / n, 1e-15);
  }
}

TEST(FourierTransform, a_row_has_the_same_bits_in_either_place_and_beside_any_other) {
  for (const std::size_t n : std::initializer_list<std::size_t>{2, 3, 4, 15, 16, 64, 101, 1000, 1001, 4096}) {
    support::Random random(44, n);
    std::vector<double> row = cosine(n), other(n);
    for (double& sample : other) sample = random.uniform(-1e3, 1e3);
    const FourierTransform transform(n), again(n);
    const auto workspace = transform.workspace(), another = transform.workspace();
    std::ranges::copy(row, transform.samples(*workspace)[0].begin());
    std::ranges::copy(other, transform.samples(*workspace)[1].begin());
    std::ranges::copy(other, again.samples(*another)[0].begin()),
        std::ranges::copy(row, again.samples(*another)[1].begin());
    EXPECT_TRUE(std::ranges::equal(transform.transform(*workspace)[0], again.transform(*another)[1])) << n;
  }
}

}  // namespace
}  // namespace clatter::observables::fourier_transform_test
