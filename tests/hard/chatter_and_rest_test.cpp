// Infinitely many impacts in a finite time, rest, and release when the force changes sign.

#include <gtest/gtest.h>

#include <numbers>

#include "hard/measure.hpp"

namespace clatter::hard::chatter_and_rest_test {
namespace {

TEST(ChatterAndRest, agrees_with_fifty_digits) { expect_agreement("chatter_and_rest"); }

TEST(ChatterAndRest, has_its_known_times) {
  const Case& one = case_of("chatter_and_rest", "R = 0.5");
  const accuracy::RunRecord record = accuracy::record_of(one.scene, 9.0);
  const auto& events = record.events;
  EXPECT_NEAR(events.at(0).time, 2.0515931595927638, 1e-14);
  EXPECT_NEAR(events.at(0).speed(), 0.57647176137699961, 1e-14);
  EXPECT_NEAR(events.at(1).time, 3.1907700695690808, 1e-14);
  const accuracy::Event &rest = events.at(events.size() - 2), &last = events.back();
  ASSERT_EQ(rest.kind, accuracy::Event::Kind::rest);
  EXPECT_NEAR(rest.time, 4.4158803670592697, 1e-14);
  EXPECT_NEAR(rest.time + rest.length, 5 * std::numbers::pi / 3, 1e-14);
  EXPECT_EQ(last.side, Side::lower);
  EXPECT_NEAR(last.time, 7.9756605890323812, 2e-14);
  EXPECT_NEAR(last.speed(), 0.7854147777624616, 2e-14);
}

}  // namespace
}  // namespace clatter::hard::chatter_and_rest_test
