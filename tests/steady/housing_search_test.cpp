// Newton's method finds the motion with a loose mass that plain repetition comes to, only sooner.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "motion/walls.hpp"
#include "point/exact_motion.hpp"
#include "support/loose_scenes.hpp"

namespace clatter::steady::housing_search_test {
namespace {

ObservedTime found(point::Problem problem, bool shortcuts, std::int64_t max_periods) {
  problem.integration.shortcuts = shortcuts, problem.time.max_periods = max_periods;
  return point::ExactMotion::of(problem)->find_steady();
}

/// The largest difference of the states of two motions, over the larger of their numbers.
double distance(const ObservedTime& one, const ObservedTime& other, const LooseMass& loose) {
  const auto a = motion::numbers_of(one.from, loose), b = motion::numbers_of(other.from, loose);
  double largest = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i])), size = std::max(size, std::abs(a[i]));
  return largest / size;
}

TEST(HousingSearch, newtons_method_finds_what_repetition_comes_to) {
  int by_newton = 0, agree = 0;
  for (std::uint64_t index = 0; index < 300; ++index) {
    const point::Problem problem = support::random_loose_scene(index);
    const ObservedTime quick = found(problem, true, 2000);
    if (quick.found_by != FoundBy::newton) continue;
    ++by_newton;
    const ObservedTime slow = found(problem, false, 20000);
    ASSERT_EQ(slow.status, Status::periodic) << index;
    EXPECT_EQ(slow.turns, quick.turns) << index;
    EXPECT_LE(distance(quick, slow, problem.loose), 1e-9) << index;
    EXPECT_LE(quick.simulated, 2 * slow.simulated) << index;
    ++agree;
  }
  EXPECT_GE(by_newton, 50);
  EXPECT_EQ(agree, by_newton);
}

/// Repeats that the multiplier nearest to 1 brings about in thousands of periods.
TEST(HousingSearch, newtons_method_finds_motion_that_settles_slowly) {
  const point::Problem problem = support::impact_damper();
  EXPECT_EQ(found(problem, false, 500).status, Status::aperiodic);
  const ObservedTime quick = found(problem, true, 500);
  EXPECT_EQ(quick.status, Status::periodic);
  EXPECT_EQ(quick.found_by, FoundBy::newton);
  EXPECT_LE(distance(quick, found(problem, false, 20000), problem.loose), 1e-9);
}

/// At the multiplier 1 of a fold nothing contracts, and of an unstable motion something grows.
TEST(HousingSearch, motion_that_repels_is_not_found) {
  point::Problem problem = support::impact_damper();
  problem.oscillator.forcing = 0.0045;  // modulated: impacts come and go
  EXPECT_EQ(found(problem, true, 3000).status, Status::aperiodic);
}

}  // namespace
}  // namespace clatter::steady::housing_search_test
