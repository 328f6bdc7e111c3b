#include "steady/repeat.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/random.hpp"

namespace clatter::steady::repeat_test {
namespace {

struct Numbers {
  double x, v;
};

/// Sections of a motion that comes to repeat after n of them, some of which nearly coincide.
std::vector<Numbers> approach(std::mt19937_64& random, std::size_t n, std::size_t sections) {
  std::uniform_real_distribution<double> part(-1, 1);
  std::vector<Numbers> cycle, motion;
  for (std::size_t i = 0; i < n; ++i)
    cycle.push_back(i > 0 && part(random) < 0 ? Numbers{cycle.back().x * 1.001, cycle.back().v}
                                              : Numbers{part(random), part(random)});
  const double rate = 0.6 + 0.3 * part(random);
  for (std::size_t i = 0; i < sections; ++i) {
    const double left = std::pow(rate, i) * part(random);
    motion.push_back({cycle[i % n].x + left, cycle[i % n].v - left});
  }
  return motion;
}

TEST(RepeatFinder, EveryNearStateIsFoundInTurn) {
  std::mt19937_64 random(71);
  for (const std::size_t n : {1u, 2u, 5u, 12u, 64u}) {
    RepeatFinder finder(1e-12);
    for (const Numbers& at : approach(random, n, 300)) {
      static_cast<void>(finder.add(at.x, at.v, -0.5));
      for (const double distance : {0.02, 1e-6, 1e-12}) {
        std::vector<std::size_t> near, all;
        for (std::size_t m = finder.next_within(distance, 1); m > 0; m = finder.next_within(distance, m + 1))
          near.push_back(m);
        for (std::size_t m = 1; m <= RepeatFinder::longest; ++m)
          if (finder.distance_over(m) <= distance) all.push_back(m);
        ASSERT_EQ(near, all) << n;
      }
    }
  }
}

TEST(RepeatFinder, SectionsAtWhichItDoesNotLookNeedOnlyBePassed) {
  std::mt19937_64 random(72);
  for (const std::size_t n : {1u, 2u, 3u, 7u, 20u}) {
    RepeatFinder adds(1e-12, 4), passes(1e-12, 4);
    std::size_t found = 0, passed = 0;
    for (const Numbers& at : approach(random, n, 400)) {
      const std::size_t repeat = adds.add(at.x, at.v, -0.5);
      if (passes.looks_next()) {
        EXPECT_EQ(passes.add(at.x, at.v, -0.5), repeat);
      } else {
        passes.pass(at.x, at.v, -0.5), ++passed;
        EXPECT_EQ(repeat, 0u);
      }
      EXPECT_EQ(passes.distance_over(n), adds.distance_over(n));
      if (repeat > 0 && found == 0) found = repeat;
    }
    EXPECT_EQ(found, n);
    EXPECT_GT(passed, 20u);
  }
}

}  // namespace
}  // namespace clatter::steady::repeat_test
