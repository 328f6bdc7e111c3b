// Critical damping from both sides, and damping so heavy that the two rates of decay lie a million apart.

#include <gtest/gtest.h>

#include <cmath>

#include "hard/measure.hpp"

namespace clatter::hard::damping_test {
namespace {

TEST(Damping, agrees_with_fifty_digits) { expect_agreement("damping"); }

TEST(Damping, goes_through_its_critical_value_without_a_step) {
  const Case &below = case_of("damping", "h = 1 - 1e-12"), &critical = case_of("damping", "h = 1"),
             &above = case_of("damping", "h = 1 + 1e-12");
  const accuracy::RunRecord from_below = accuracy::record_of(below.scene, below.duration),
                            at = accuracy::record_of(critical.scene, critical.duration),
                            from_above = accuracy::record_of(above.scene, above.duration);
  for (const accuracy::RunRecord* near : {&from_below, &from_above}) {
    const support::Deviation d = support::deviation(*near, at);
    EXPECT_TRUE(d.same_events) << d.difference;
    EXPECT_LT(d.largest(), 1e-11);  // h moves the motion by a few times its own change
    EXPECT_GT(d.largest(), 1e-14);  // and does move it
  }
}

}  // namespace
}  // namespace clatter::hard::damping_test
