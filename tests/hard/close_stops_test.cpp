// Stops so close that the mass hits both within 1e-9, far below the resolution of a displacement under a force of 1.

#include <gtest/gtest.h>

#include <cmath>

#include "hard/measure.hpp"

namespace clatter::hard::close_stops_test {
namespace {

TEST(CloseStops, agrees_with_fifty_digits) {
  for (const Case& one : cases_of("close_stops")) {
    // time is kept to an ulp of the forcing period, and just after a release the force grows with the time since: the
    // first flight across takes (6 gap/f)^(1/3)
    const double flight = std::cbrt(12 * one.scene.stops.upper), period = 2 * pi<double>();
    expect_agreement(one, epsilon<double>() * std::max(1.0, one.duration > 1 ? period / flight : 0.0));
  }
}

TEST(CloseStops, are_hit_one_after_the_other_with_R_times_the_speed) {
  const Case& one = case_of("close_stops", "2e-9 apart, R = 0.9");
  const accuracy::RunRecord record = accuracy::record_of(one.scene, one.duration);
  ASSERT_GT(record.events.size(), 30u);
  for (std::size_t i = 1; i < record.events.size(); ++i) {
    const accuracy::Event &before = record.events[i - 1], &event = record.events[i];
    EXPECT_EQ(sign_of(event.side), -sign_of(before.side));
    EXPECT_NEAR(event.speed(), 0.9 * before.speed(), 1e-6 * before.speed());  // the force has 1e-6 of time to act
    if (i == 1) {
      EXPECT_NEAR(event.time - before.time, 2e-9 / 0.9, 1e-15);
    }
  }
}

}  // namespace
}  // namespace clatter::hard::close_stops_test
