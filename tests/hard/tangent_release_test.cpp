// A release near the force's extremum, at which the sign of the pressing force depends on the rounding of |f| - gap.

#include <gtest/gtest.h>

#include <cmath>

#include "hard/measure.hpp"

namespace clatter::hard::tangent_release_test {
namespace {

TEST(TangentRelease, agrees_with_fifty_digits) { expect_agreement("tangent_release"); }

TEST(TangentRelease, comes_the_square_root_of_the_excess_after_the_extremum) {
  // f sin(theta) = gap from theta = pi/2 on: theta - pi/2 = arccos(gap)
  for (const char* what : {"|f| = gap (1 + 1e-3)", "|f| = gap (1 + 1e-9)", "|f| = gap (1 + 1e-15)"}) {
    const Case& one = case_of("tangent_release", what);
    const accuracy::Event rest = accuracy::record_of(one.scene, one.duration).events.at(0);
    ASSERT_EQ(rest.kind, accuracy::Event::Kind::rest) << what;
    EXPECT_NEAR(rest.length * one.scene.oscillator.frequency, std::acos(one.scene.stops.upper), 4 * epsilon<double>())
        << what;
  }
}

TEST(TangentRelease, a_force_that_just_touches_neither_holds_nor_lets_go) {
  const Case &never = case_of("tangent_release", "|f| = gap"), &always = case_of("tangent_release", "load - gap = |f|");
  for (const accuracy::Event& event : accuracy::record_of(never.scene, never.duration).events)
    EXPECT_NE(event.kind, accuracy::Event::Kind::rest);
  const accuracy::RunRecord held = accuracy::record_of(always.scene, always.duration);
  EXPECT_EQ(held.impacts, 0.0);
  EXPECT_EQ(held.x, always.scene.stops.upper);
}

}  // namespace
}  // namespace clatter::hard::tangent_release_test
