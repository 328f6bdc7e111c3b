#include "study/comparison.hpp"

#include <gtest/gtest.h>

namespace clatter {
namespace {

Event impact(double time, double speed = 1.0) { return {Event::Kind::impact, Side::upper, time, speed, 0.0}; }

TEST(Comparison, finds_what_is_missed_and_what_is_doubled) {
  const std::vector<Event> reference{impact(1), impact(2), impact(3), impact(4)};
  const std::vector<Event> run{impact(1.01), impact(2.99), impact(3.4), impact(4.01, 0.9)};
  const ContactErrors errors = compare(run, reference, 5);
  EXPECT_EQ(errors.missed, 1u);
  EXPECT_EQ(errors.doubled, 1u);
  EXPECT_NEAR(errors.time, 0.01, 1e-12);
  EXPECT_NEAR(errors.speed, 0.1, 1e-12);
}

}  // namespace
}  // namespace clatter
