#include "sweep/time_left.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "support/random.hpp"

namespace clatter::sweep::time_left_test {
namespace {

/// The worst of what is told against the truth, as a factor, while points of such costs are run one after the other:
/// from two seconds on, as long as there is a share of the time left.
double worst_factor(const std::vector<double>& seconds, double share_left) {
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0), total = static_cast<double>(seconds.size());
  TimeLeft time_left;
  double now = 0, worst = 1;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    now += seconds[i];
    time_left.add(now, static_cast<double>(i + 1));
    const double truth = all - now;
    if (now < 2 || truth < share_left * all) continue;
    const auto told = time_left.at(now, total);
    EXPECT_TRUE(told) << "after " << now << " s";
    if (told) worst = std::max({worst, *told / truth, truth / *told});
  }
  return worst;
}

TEST(TimeLeft, of_points_that_cost_the_same_is_right) {
  EXPECT_NEAR(worst_factor(std::vector<double>(100, 0.3), 0.02), 1.0, 1e-9);
  EXPECT_NEAR(worst_factor(std::vector<double>(4, 60.0), 0.02), 1.0, 1e-12);
}

TEST(TimeLeft, of_points_in_no_order_is_right_within_a_factor_of_three) {
  for (const std::uint64_t i : {1U, 2U, 3U, 4U, 5U}) {
    support::Random random(1, i);
    std::vector<double> seconds(3000);
    for (double& cost : seconds) cost = random.logarithmic(1e-5, 1e-1);
    EXPECT_LT(worst_factor(seconds, 0.05), 3.0) << i;
  }
}

TEST(TimeLeft, soon_forgets_that_the_first_points_were_dear_or_cheap) {
  std::vector<double> seconds(100, 0.02);
  seconds.resize(4000, 0.001);
  EXPECT_LT(worst_factor({seconds.begin() + 70, seconds.end()}, 0.02), 3.0);  // 0.6 s dear
  std::ranges::reverse(seconds);
  seconds.resize(4600, 0.02);
  EXPECT_LT(worst_factor({seconds.begin() + 3600, seconds.end()}, 0.02), 3.0);  // 0.3 s cheap
}

TEST(TimeLeft, does_not_count_points_finished_before) {
  TimeLeft time_left(900);
  for (int i = 1; i <= 10; ++i) time_left.add(i, 900 + i);
  EXPECT_NEAR(*time_left.at(10, 1000), 90.0, 1e-9);
}

TEST(TimeLeft, tells_nothing_before_there_is_something_to_tell_it_from) {
  TimeLeft time_left;
  EXPECT_FALSE(time_left.at(10, 100));  // nothing is finished
  for (int i = 1; i < 4; ++i) {
    time_left.add(0.2 * i, i);
    EXPECT_FALSE(time_left.at(10, 100)) << i;
  }
  time_left.add(0.8, 4);
  EXPECT_FALSE(time_left.at(0.9, 100));  // too soon
  EXPECT_TRUE(time_left.at(1.0, 100));
  EXPECT_TRUE(TimeLeft(time_left).at(1.0, 5));
}

TEST(TimeLeft, a_quarter_of_few_points_is_enough) {
  TimeLeft time_left;
  time_left.add(60, 1);
  EXPECT_NEAR(*time_left.at(60, 4), 180.0, 1e-12);
  EXPECT_FALSE(time_left.at(60, 5));
}

TEST(TimeLeft, goes_down_while_nothing_is_finished_and_up_once_that_is_overdue) {
  TimeLeft time_left;
  for (int i = 1; i <= 9; ++i) time_left.add(10 * i, i);
  EXPECT_NEAR(*time_left.at(90, 10), 10.0, 1e-9);
  EXPECT_NEAR(*time_left.at(97, 10), 3.0, 1e-9);
  EXPECT_NEAR(*time_left.at(130, 10), 30.0, 1e-9);  // 30 s overdue
}

TEST(TimeLeft, takes_parts_of_points) {
  TimeLeft time_left;
  for (int i = 1; i <= 20; ++i) time_left.add(0.1 * i, 0.01 * i);
  EXPECT_NEAR(*time_left.at(2, 10), 98.0, 1e-9);
}

TEST(TimeLeft, is_nothing_at_the_end_however_soon_that_comes) {
  TimeLeft time_left;
  time_left.add(0.001, 5);
  EXPECT_EQ(*time_left.at(0.001, 5), 0.0);
}

}  // namespace
}  // namespace clatter::sweep::time_left_test
