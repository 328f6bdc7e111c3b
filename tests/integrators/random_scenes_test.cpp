// Random scenes with chatter and rest against the same source in 50 digits: the same impacts and rests at the same
// times.

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "support/course.hpp"

namespace clatter {
namespace {

/// Scenes nobody chose: damping none to heavy, two stops with a restitution each, a load in half of them.
class RandomScenes {
 public:
  Scene next() {
    Scene scene;
    scene.oscillator = {uniform(0, 1) < 0.2 ? 0.0 : logarithmic(1e-2, 3),
                        (uniform(0, 1) < 0.5 ? -1 : 1) * logarithmic(0.1, 3), logarithmic(0.2, 4),
                        uniform(0, 1) < 0.5 ? 0.0 : uniform(-0.5, 0.5)};
    const double gap = logarithmic(1e-2, 1.5);
    scene.stops = {-gap * uniform(0.2, 1.2), gap * uniform(0.2, 1.2), uniform(0, 0.9), uniform(0, 0.9)};
    scene.start = {uniform(scene.stops.lower, scene.stops.upper), uniform(-1, 1), uniform(0, 6)};
    return scene;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double logarithmic(double a, double b) { return a * std::pow(b / a, uniform(0, 1)); }

  std::mt19937_64 random_{20230};
};

TEST(RandomScenes, agree_with_fifty_digits_in_every_impact_and_rest) {
  RandomScenes scenes;
  std::size_t impacts = 0, chatters = 0, rests = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = scenes.next();
    const double duration = 3.3 * 2 * std::numbers::pi / scene.oscillator.frequency;
    const Deviation d = deviation(course_of(scene, duration), reference_of(scene, duration));
    // a few ulps of the length of the run, times what a hundred impacts make of them in motion that separates slowly
    EXPECT_TRUE(d.same_events) << d.difference << "\n" << configuration_of(scene, duration);
    EXPECT_LT(d.time, 1e-11) << configuration_of(scene, duration);
    EXPECT_LT(d.speed, 1e-11) << configuration_of(scene, duration);
    impacts += d.impacts, chatters += d.chatters, rests += d.rests;
  }
  EXPECT_GT(impacts, 1000u);
  EXPECT_GT(chatters, 50u);
  EXPECT_GT(rests, 100u);
}

}  // namespace
}  // namespace clatter
