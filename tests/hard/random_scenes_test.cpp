// Random scenes with chatter and rest against the same source in 50 digits: the same impacts and rests at the same
// times.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "support/deviation.hpp"
#include "support/random.hpp"
#include "support/scene_range.hpp"

namespace clatter::hard::random_scenes_test {
namespace {

/// A random scene: damping from none to heavy, two stops with a restitution each, a load in half of the scenes, in a
/// fifth of them no spring, an unstable one, or one of another stiffness than 1.
point::Problem random_scene(std::uint64_t index) {
  support::Random random(20230, index);
  point::Problem scene;
  scene.oscillator = {random.happens(0.2) ? 0.0 : random.logarithmic(1e-2, 3),
                      random.sign() * random.logarithmic(0.1, 3), random.logarithmic(0.2, 4),
                      random.happens(0.5) ? 0.0 : random.uniform(-0.5, 0.5)};
  const double gap = random.logarithmic(1e-2, 1.5);
  scene.stops = {-gap * random.uniform(0.2, 1.2), gap * random.uniform(0.2, 1.2), random.uniform(0, 0.9),
                 random.uniform(0, 0.9)};
  scene.start = {random.uniform(scene.stops.lower, scene.stops.upper), random.uniform(-1, 1), random.uniform(0, 6)};
  if (index % 5 == 4) {
    support::Random other(20240, index);
    const double kind = other.uniform(0, 1);
    scene.oscillator.stiffness = kind < 0.3   ? 0
                                 : kind < 0.6 ? -other.logarithmic(1e-2, 2)
                                              : other.logarithmic(1e-2, 20);
  }
  return scene;
}

/// Quarter number `part` of the scenes, so that quarters run side by side.
class RandomScenes : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomScenes, agree_with_fifty_digits_in_every_impact_and_rest) {
  const support::SceneRange range = support::scene_range(600);
  std::size_t scenes = 0, impacts = 0, chatters = 0, rests = 0;
  double worst = 0, worst_ratio = 0;
  std::uint64_t worst_index = 0;
  for (std::uint64_t index = range.from + GetParam(); index < range.to; index += 4) {
    const point::Problem scene = random_scene(index);
    const double duration = 3.3 * 2 * pi<double>() / scene.oscillator.frequency;
    const accuracy::RunRecord record = accuracy::record_of(scene, duration),
                              reference = accuracy::reference_of(scene, duration);
    const support::Deviation d = support::deviation(record, reference);
    EXPECT_EQ(record.outcome, stepping::Outcome::completed);
    EXPECT_TRUE(d.same_events) << d.difference << "\n" << support::configuration_of(scene, duration);
    // a rounding an impact; if motions separate, the effect of the rounding of the inputs
    if (const double rounding = (16 + record.impacts) * epsilon<double>(); d.largest() > rounding) {
      const double one_ulp = support::conditioning(scene, reference);
      EXPECT_LE(d.largest(), std::max(rounding, 64 * one_ulp)) << support::configuration_of(scene, duration);
      worst_ratio = std::max(worst_ratio, d.largest() / one_ulp);
    }
    if (d.largest() > worst) worst = d.largest(), worst_index = index;
    ++scenes, impacts += d.impacts, chatters += d.chatters, rests += d.rests;
  }
  if (scenes >= 100) {  // fewer scenes needn't have all kinds of events
    EXPECT_GT(impacts, 20 * scenes);
    EXPECT_GT(chatters, scenes);
    EXPECT_GT(rests, 2 * scenes);
  }
  std::cout << scenes << " scenes, " << impacts << " impacts, " << chatters << " chatters, " << rests
            << " rests; largest error " << worst << " (scene " << worst_index
            << "); beyond a rounding an impact at most " << worst_ratio
            << " times the effect of one ulp of the inputs\n";
}

INSTANTIATE_TEST_SUITE_P(Quarter, RandomScenes, testing::Range<std::uint64_t>(0, 4));

}  // namespace
}  // namespace clatter::hard::random_scenes_test
