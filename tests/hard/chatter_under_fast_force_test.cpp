// A chatter slower than the force: the pressing force changes sign during it, so that it must not be summed.

#include <gtest/gtest.h>

#include "hard/measure.hpp"

namespace clatter::hard::chatter_under_fast_force_test {
namespace {

TEST(ChatterUnderFastForce, agrees_with_fifty_digits) { expect_agreement("chatter_under_fast_force"); }

TEST(ChatterUnderFastForce, is_not_completed_while_the_force_turns_round) {
  for (const Case& one : cases_of("chatter_under_fast_force")) {
    const accuracy::RunRecord record = accuracy::record_of(one.scene, one.duration);
    EXPECT_GE(record.events.size(), 2u) << one.what;
    for (const accuracy::Event& event : record.events) EXPECT_EQ(event.kind, accuracy::Event::Kind::impact) << one.what;
  }
}

}  // namespace
}  // namespace clatter::hard::chatter_under_fast_force_test
