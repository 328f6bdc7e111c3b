#include "certificates/sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace clatter::certificates::sample_test {
namespace {

TEST(Sample, is_spread_evenly_from_the_first_to_the_last) {
  std::vector<int> items(101);
  std::iota(items.begin(), items.end(), 0);
  EXPECT_EQ(spread(items, 5), (std::vector{0, 25, 50, 75, 100}));
  EXPECT_EQ(spread(items, 1), std::vector{50});
  EXPECT_EQ(spread(items, 101), items);
  EXPECT_EQ(spread(items, 1000), items);
  EXPECT_EQ(spread(std::vector<int>{}, 3), std::vector<int>{});
}

TEST(Sample, has_no_item_twice) {
  std::vector<int> items(7);
  std::iota(items.begin(), items.end(), 0);
  for (std::size_t count = 2; count < 7; ++count) {
    std::vector<int> chosen = spread(items, count);
    EXPECT_EQ(chosen.size(), count);
    EXPECT_EQ(std::unique(chosen.begin(), chosen.end()), chosen.end());
  }
}

}  // namespace
}  // namespace clatter::certificates::sample_test
