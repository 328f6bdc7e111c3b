// Motion under dry friction in 50 digits: its fixed points, and what follows a release from a rest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "point/fixed_point.hpp"
#include "point/point.hpp"
#include "point/resting_motion.hpp"
#include "support/friction_scenes.hpp"

namespace clatter::point::friction_fifty_digits_test {
namespace {

PointResult run(const Problem& problem) {
  ThreadScratch scratch;
  return run_point(problem, scratch);
}

/// The motion of a problem after so many forcing periods, from section to section.
PointResult long_run(Problem problem, std::int64_t periods) {
  problem.time.mode = steady::Mode::transient;
  problem.time.duration = static_cast<double>(periods) * period_of(problem.oscillator);
  problem.observe.section = periods;
  return run(problem);
}

TEST(FixedPoint, of_motion_that_sticks_is_the_one_that_it_settles_on) {
  for (const double start : {0.0, 0.1}) {  // mirror images
    Problem problem = support::rubbing_with_a_stick();
    problem.start.displacement = start;
    const PointResult settled = long_run(problem, 60);
    motion::State<double> near;
    near.x = settled.section_x.back() + 1e-4, near.v = settled.section_v.back() - 1e-4;
    const auto found = fixed_point(problem, near, 1);
    ASSERT_TRUE(found);
    EXPECT_NEAR(static_cast<double>(found->start.x), settled.section_x.back(), 1e-14);
    EXPECT_NEAR(static_cast<double>(found->start.v), settled.section_v.back(), 1e-14);
  }
}

/// A ball on a table, which rubs in its guide.
Problem rubbing_ball(double f, double R, const Friction& friction) {
  Problem scene;
  scene.oscillator = {.forcing = f, .load = -1, .stiffness = 0.0};
  scene.stops = {0.0, std::numeric_limits<double>::infinity(), R, 1.0};
  scene.friction = friction;
  return scene;
}

/// Sections a period of the motion apart are the same to the last bit, since each rest begins it anew.
void expect_to_repeat(const Problem& problem, const RestingMotion& motion) {
  ASSERT_EQ(motion.kind, RestingMotion::Kind::periodic);
  const PointResult settled = long_run(problem, 300);
  for (std::size_t i = 0; i < motion.sections.size(); ++i) {
    const auto distance = [&](std::size_t n) {
      return std::max(std::abs(settled.section_x[n] - motion.sections[i].x),
                      std::abs(settled.section_v[n] - motion.sections[i].v));
    };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = settled.section_x.size() - motion.sections.size(); n < settled.section_x.size(); ++n)
      nearest = std::min(nearest, distance(n));
    EXPECT_LT(nearest, 1e-13) << i;
  }
}

TEST(RubbingRest, even_after_elastic_impacts_is_followed_by_the_motion_that_a_long_run_ends_in) {
  for (const double R : {0.3, 0.8, 1.0}) {
    const Problem problem = rubbing_ball(1.54, R, {0.4, 0.4});
    expect_to_repeat(problem, resting_motion(problem, Side::lower));
  }
}

TEST(RubbingRest, that_no_force_ends_is_followed_by_none) {
  EXPECT_EQ(resting_motion(rubbing_ball(1.29, 0.5, {0.2, 0.3}), Side::lower).kind, RestingMotion::Kind::none);
  EXPECT_NE(resting_motion(rubbing_ball(1.31, 0.5, {0.2, 0.3}), Side::lower).kind, RestingMotion::Kind::none);
}

TEST(RubbingRest, is_found_as_steady_motion) {
  Problem problem = rubbing_ball(1.54, 1.0, {0.4, 0.4});
  problem.observe.impacts = true;
  const PointResult found = run(problem);
  const RestingMotion motion = resting_motion(problem, Side::lower);
  EXPECT_EQ(found.status, steady::Status::periodic);
  EXPECT_EQ(found.observed_turns, static_cast<double>(motion.sections.size()));
  EXPECT_GT(found.rest_fraction[0], 0.0);
}

}  // namespace
}  // namespace clatter::point::friction_fifty_digits_test
