// Motion under friction that meets no stop any more settles to one periodic motion, which is found at once.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "point/point.hpp"
#include "scene/response.hpp"
#include "support/random.hpp"

namespace clatter::steady::slipping_test {
namespace {

/// A rubbing mass, whose response without friction lies between its stops.
point::Problem rubbing_scene(std::uint64_t index) {
  support::Random random(20911, index);
  point::Problem scene;
  scene.oscillator = {random.logarithmic(1e-3, 0.3), 1, random.uniform(0.2, 3), 0};
  if (random.happens(0.3)) scene.oscillator.load = random.uniform(-1, 1);
  const double friction = random.logarithmic(1e-4, 0.7);
  scene.friction = {friction, friction};
  const double most = std::abs(scene.oscillator.load) + steady_response(scene.oscillator).amplitude;
  const double gap = most * random.uniform(1.05, 3);
  scene.stops = {-gap, gap, random.uniform(0.1, 1), random.uniform(0.1, 1)};
  scene.start = {random.uniform(-gap, gap), random.uniform(-2, 2), random.uniform(0, 6)};
  return scene;
}
point::PointResult result_of(const point::Problem& scene) {
  point::ThreadScratch scratch;
  return run_point(scene, scratch);
}

TEST(Slipping, is_found_soon_and_is_what_long_runs_come_to) {
  int found = 0, late = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    point::Problem scene = rubbing_scene(index);
    const point::PointResult steady = result_of(scene);
    if (steady.found_by != FoundBy::newton || steady.observed_turns != 1) continue;
    ++found;
    late += steady.periods > 40;
    const double periods = std::ceil(steady.settling_estimate) + 20;
    scene.time.mode = Mode::transient, scene.time.duration = periods * period_of(scene.oscillator);
    const point::PointResult run = result_of(scene);
    const double size = std::abs(steady.end.displacement) + std::abs(steady.end.velocity);
    EXPECT_NEAR(run.end.displacement, steady.end.displacement, 1e-8 * size) << index;
    EXPECT_NEAR(run.end.velocity, steady.end.velocity, 1e-8 * size) << index;
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(late, found / 4);  // those that meet stops for long
}

/// With a static level above the kinetic one two motions needn't come closer: nothing is proved there.
TEST(Slipping, of_two_levels_is_found_as_before) {
  point::Problem scene = rubbing_scene(0);
  scene.oscillator = {0.001, 1, 2, 0}, scene.friction = {0.001, 0.001}, scene.stops = {-1, 1, 0.7, 0.7},
  scene.start = {};
  const point::PointResult same = result_of(scene);
  EXPECT_EQ(same.found_by, FoundBy::newton);
  EXPECT_LT(same.periods, 20);
  scene.friction.static_level = 0.002;
  const point::PointResult other = result_of(scene);
  EXPECT_GT(other.periods, 40);
  EXPECT_NEAR(other.end.displacement, same.end.displacement, 1e-9);
  EXPECT_NEAR(other.end.velocity, same.end.velocity, 1e-9);
}

}  // namespace
}  // namespace clatter::steady::slipping_test
