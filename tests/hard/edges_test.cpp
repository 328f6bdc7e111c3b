// Starts on a stop.

#include <gtest/gtest.h>

#include <numbers>

#include "hard/measure.hpp"

namespace clatter::hard::edges_test {
namespace {

TEST(Edges, agrees_with_fifty_digits) { expect_agreement("edges"); }

accuracy::RunRecord from(const char* what) {
  const Case& one = case_of("edges", what);
  return accuracy::record_of(one.scene, one.duration);
}

TEST(Edges, moving_in_is_an_impact_at_once_and_only_one) {
  const auto events = from("start moving in").events;
  EXPECT_EQ(events.at(0).kind, accuracy::Event::Kind::impact);
  EXPECT_EQ(events[0].time, 0.0);
  EXPECT_EQ(events[0].speed(), 0.25);
  EXPECT_GT(events.at(1).time, 0.0);
}

TEST(Edges, moving_out_is_none) { EXPECT_GT(from("start moving out").events.at(0).time, 1.0); }

TEST(Edges, at_rest_it_stays_while_pressed) {
  const accuracy::Event rest =
      from("start at rest, pressed").events.at(0);  // until f sin(theta) = 0.5 (eq. 26): from phase pi/2 to 5 pi/6
  EXPECT_EQ(rest.kind, accuracy::Event::Kind::rest);
  EXPECT_NEAR(rest.length, (5 - 3) * std::numbers::pi / 6 / 0.5, 1e-14);
}

TEST(Edges, at_rest_it_leaves_when_pulled) {
  const accuracy::Event first = from("start at rest, pulled").events.at(0);
  EXPECT_EQ(first.kind, accuracy::Event::Kind::impact);
  EXPECT_GT(first.time, 1.0);
}

}  // namespace
}  // namespace clatter::hard::edges_test
