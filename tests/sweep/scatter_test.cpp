#include "sweep/scatter.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace clatter::sweep::scatter_test {
namespace {

std::vector<std::size_t> order_of(const auto& scatter) {
  std::vector<std::size_t> order;
  for (std::size_t turn = 0; turn < scatter.turns(); ++turn)
    if (const auto number = scatter.number(turn)) order.push_back(*number);
  return order;
}

TEST(Scatter, has_every_number_once) {
  for (std::size_t count = 0; count < 3000; count += 1 + count / 50) {
    for (const std::size_t slab : {std::size_t{1}, std::size_t{7}, std::size_t{64}, count, count + 1}) {
      const std::vector<std::size_t> order = order_of(ScatterInSlabs(count, slab));
      ASSERT_EQ(order.size(), count);
      std::vector<char> there(count, 0);
      for (const std::size_t number : order) {
        ASSERT_LT(number, count);
        ++there[number];
      }
      EXPECT_EQ(there, std::vector<char>(count, 1)) << count << ' ' << slab;
    }
  }
}

TEST(Scatter, any_beginning_has_its_share_of_every_part) {
  for (const std::size_t count : {400U, 1000U, 1024U, 5000U, 100000U}) {
    const std::vector<std::size_t> order = order_of(Scatter(count));
    for (const std::size_t beginning : {count / 10, count / 3, count}) {
      constexpr std::size_t parts = 5;
      std::vector<double> in_part(parts, 0);
      for (std::size_t i = 0; i < beginning; ++i) ++in_part[order[i] * parts / count];
      const double fair = static_cast<double>(beginning) / parts;
      for (const double number : in_part) {
        EXPECT_GT(number, fair / 2) << count << ", the first " << beginning;
        EXPECT_LT(number, fair * 2) << count << ", the first " << beginning;
      }
    }
  }
}

TEST(Scatter, in_slabs_does_each_at_a_time) {
  for (const std::size_t count : {1000U, 1024U, 5000U}) {
    const std::vector<std::size_t> order = order_of(ScatterInSlabs(count, 100));
    std::size_t changes = 0;
    for (std::size_t i = 1; i < count; ++i) changes += order[i] / 100 != order[i - 1] / 100 ? 1 : 0;
    EXPECT_EQ(changes, (count - 1) / 100) << count;
  }
}

}  // namespace
}  // namespace clatter::sweep::scatter_test
