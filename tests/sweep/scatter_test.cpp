#include "sweep/scatter.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace clatter::sweep {
namespace {

std::vector<std::size_t> order_of(std::size_t count) {
  const Scatter scatter(count);
  std::vector<std::size_t> order;
  for (std::size_t turn = 0; turn < scatter.turns(); ++turn)
    if (const auto number = scatter.number(turn)) order.push_back(*number);
  return order;
}

TEST(Scatter, has_every_number_once) {
  for (std::size_t count = 0; count < 3000; count += 1 + count / 50) {
    const std::vector<std::size_t> order = order_of(count);
    ASSERT_EQ(order.size(), count);
    std::vector<char> there(count, 0);
    for (const std::size_t number : order) {
      ASSERT_LT(number, count);
      ++there[number];
    }
    EXPECT_EQ(there, std::vector<char>(count, 1)) << count;
  }
}

TEST(Scatter, any_beginning_has_its_share_of_every_part) {
  for (const std::size_t count : {400U, 1000U, 1024U, 5000U, 100000U}) {
    const std::vector<std::size_t> order = order_of(count);
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

}  // namespace
}  // namespace clatter::sweep
