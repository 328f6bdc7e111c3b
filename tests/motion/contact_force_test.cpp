#include "motion/contact_force.hpp"

#include <gtest/gtest.h>

#include "scene/stops.hpp"

namespace clatter::motion::contact_force_test {
namespace {

using Light = ArcConstants<double, Effects{Damping::light, Forcing::regular}>;

TEST(Impact, a_stop_releases_where_the_pressing_force_falls_to_zero) {
  for (double f : {1.0, -1.0})
    for (double load : {0.0, 0.2})
      for (const Side side : {Side::lower, Side::upper}) {
        const Light constants({0.1, f, 0.5, load});
        const auto stop = stop_at<double>({-0.5, 0.5, 0.5, 0.5}, side);
        const auto turns = release_phase(constants, stop);
        ASSERT_TRUE(turns);
        EXPECT_TRUE(*turns >= 0.0 && *turns < 1.0);
        const auto press = contact_force(constants, stop, sine_cosine_of_turns(*turns));
        EXPECT_NEAR(press.force, 0.0, 4e-16);
        EXPECT_LT(press.rate, 0.0);
      }
}

TEST(Impact, a_force_below_the_gap_never_releases) {
  const auto upper = stop_at<double>({-0.5, 0.5, 0.5, 0.5}, Side::upper);
  EXPECT_FALSE(release_phase(Light({0.1, 0.4, 0.5, 1.0}), upper));  // load 1 presses with 0.5 +- 0.4
  EXPECT_FALSE(release_phase(Light({0.1, 0.5, 0.5, 1.0}), upper));  // the force just touches zero
  EXPECT_TRUE(release_phase(Light({0.1, 0.5000001, 0.5, 1.0}), upper));
}

}  // namespace
}  // namespace clatter::motion::contact_force_test
