// Motion that a stop releases from rest time and again repeats, if only after many periods.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "point/point.hpp"

namespace clatter::point::resting_motion_test {
namespace {

/// A ball under gravity on a table whose acceleration is f of it, from x = 0 at v = 2.8.
Problem ball(double f, double R) {
  Problem scene;
  scene.oscillator = {.forcing = f, .load = -1, .stiffness = 0.0};
  scene.stops = {0.0, std::numeric_limits<double>::infinity(), R, 1.0};
  scene.start.velocity = 2.8;
  return scene;
}

PointResult result_of(const Problem& scene) {
  ThreadScratch scratch;
  return run_point(scene, scratch);
}

/// Forcing periods after which a long run is in the very state, to the last bit, in which it was before.
std::optional<std::size_t> repeats_after(Problem scene, std::size_t periods) {
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = static_cast<double>(periods) * 2 * pi<double>();
  scene.observe.section = static_cast<std::int64_t>(periods);
  const PointResult run = result_of(scene);
  const std::size_t last = run.section_x.size() - 1;
  for (std::size_t n = 1; n <= last; ++n)
    if (run.section_x[last - n] == run.section_x[last] && run.section_v[last - n] == run.section_v[last]) return n;
  return std::nullopt;
}

TEST(RestingMotion, that_does_not_repeat_within_64_periods_is_told_to_do_so_later_and_does) {
  for (const double f : {1.45, 1.5, 1.6, 1.7}) {
    const PointResult found = result_of(ball(f, 0.8));
    EXPECT_EQ(found.status, steady::Status::aperiodic) << f;
    EXPECT_EQ(found.found_by, steady::FoundBy::rests) << f;
    const auto period = repeats_after(ball(f, 0.8), 2000);
    ASSERT_TRUE(period) << f;
    EXPECT_GT(*period, 64u) << f;
  }
}

TEST(RestingMotion, that_repeats_soon_is_periodic_and_motion_without_a_rest_is_not_told_to_repeat) {
  const PointResult soon = result_of(ball(1.4, 0.8));
  EXPECT_EQ(soon.status, steady::Status::periodic);
  EXPECT_EQ(repeats_after(ball(1.4, 0.8), 2000), static_cast<std::size_t>(soon.observed_turns));
  Problem chaos;  // of Fig. 23: no force can hold the mass on a stop
  chaos.oscillator = {.damping = 0.1, .forcing = -1, .frequency = 0.9};
  chaos.stops = {-3, 3, 0.7, 0.7};
  const PointResult found = result_of(chaos);
  EXPECT_EQ(found.status, steady::Status::aperiodic);
  EXPECT_EQ(found.found_by, steady::FoundBy::nothing);
}

}  // namespace
}  // namespace clatter::point::resting_motion_test
