// R = 0: the mass stays on the stop that it hits until the force releases it.

#include <gtest/gtest.h>

#include <numbers>

#include "hard/measure.hpp"
#include "support/runs.hpp"

namespace clatter::hard::inelastic_test {
namespace {

TEST(Inelastic, agrees_with_fifty_digits) { expect_agreement("inelastic"); }

TEST(Inelastic, rests_at_each_contact_and_leaves_where_the_force_turns) {
  const Case& one = case_of("inelastic", "R = 0");
  const accuracy::RunRecord record = accuracy::record_of(one.scene, 4 * std::numbers::pi);
  ASSERT_EQ(record.events.size(), 4u);  // two impacts, each with its rest
  const accuracy::Event &upper = record.events[1], &lower = record.events[3];
  EXPECT_NEAR(upper.time + upper.length, 5 * std::numbers::pi / 3, 1e-14);
  EXPECT_NEAR(lower.time + lower.length, 11 * std::numbers::pi / 3, 2e-14);
}

TEST(Inelastic, repeats_after_exactly_one_forcing_period) {
  const support::Steady steady = support::steady_of(case_of("inelastic", "R = 0").scene);
  EXPECT_EQ(steady.status, steady::Status::periodic);
  EXPECT_EQ(steady.turns, 1.0);
  EXPECT_EQ(steady.length, 4 * std::numbers::pi);
}

}  // namespace
}  // namespace clatter::hard::inelastic_test
