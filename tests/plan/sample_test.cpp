#include "plan/sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace clatter::plan::sample_test {
namespace {

TEST(Sample, has_one_number_of_each_stretch_and_the_stretches_are_all_numbers) {
  for (const std::size_t count : {1UL, 7UL, 1000UL, 1001UL, 30'000'001UL})
    for (const std::size_t most : {1UL, 6UL, 1000UL}) {
      const Sample sample(count, most);
      ASSERT_EQ(sample.size(), std::min(count, most));
      std::size_t first = 0;
      for (std::size_t i = 0; i < sample.size(); ++i) {
        const auto [number, weight] = sample[i];
        ASSERT_GE(number, first);
        ASSERT_LT(number, first + weight);
        ASSERT_TRUE(weight == count / sample.size() || weight == count / sample.size() + 1);
        first += weight;
      }
      EXPECT_EQ(first, count);
    }
}

TEST(Sample, of_few_numbers_is_all_of_them) {
  const Sample sample(501, 1'000'000);
  ASSERT_EQ(sample.size(), 501u);
  for (std::size_t i = 0; i < sample.size(); ++i) EXPECT_EQ(sample[i].number, i);
  EXPECT_EQ(Sample(0, 10).size(), 0u);
}

TEST(Sample, keeps_step_with_no_axis) {
  constexpr std::size_t size = 10'000, length = 1000;  // of the fastest axis, whose place a fixed stride would repeat
  const Sample sample(size * length, size);
  std::array<int, 10> tenths{};
  for (std::size_t i = 0; i < size; ++i) ++tenths[sample[i].number % length * tenths.size() / length];
  for (const int hits : tenths) EXPECT_NEAR(hits, 1000, 4 * 30);  // 4 sigma of a binomial count: sqrt(1e4 * 0.1 * 0.9)
}

}  // namespace
}  // namespace clatter::plan::sample_test
