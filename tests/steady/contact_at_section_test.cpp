#include "steady/contact_at_section.hpp"

#include <gtest/gtest.h>

#include "steady/repeat.hpp"

namespace clatter::steady::contact_at_section_test {
namespace {

constexpr double period = 5.0, h = 1e-10;  // of a time before or after an impact

Scene between_stops() {
  Scene scene;
  scene.stops = {-1.0, 1.0, 0.6, 0.8};
  return scene;
}

// Without a force the motion is straight over so short a time: before the impact x = 1 - v h, after it x = 1 + R v h'
// at -h', and the one before is continued to that.
TEST(BeyondContact, takes_a_state_just_before_an_impact_to_the_motion_after_it) {
  const BeyondContact beyond(between_stops(), period);
  const SectionNumbers upper = beyond({1 - 2 * h, 2.0}), lower = beyond({-1 + 3 * h, -3.0});
  EXPECT_NEAR(upper.x - 1, 0.8 * 2 * h, 1e-15);  // rounding of x
  EXPECT_DOUBLE_EQ(upper.v, -0.8 * 2);
  EXPECT_NEAR(lower.x + 1, -0.6 * 3 * h, 1e-15);
  EXPECT_DOUBLE_EQ(lower.v, 0.6 * 3);
}

TEST(BeyondContact, keeps_all_other_states) {
  const BeyondContact beyond(between_stops(), period);
  for (const SectionNumbers at : {SectionNumbers{1 - 2 * h, -2.0}, {1 - 1e-7, 2.0}, {0.3, 1.0}, {1.0, 0.0}}) {
    EXPECT_EQ(beyond(at).x, at.x);
    EXPECT_EQ(beyond(at).v, at.v);
  }
  Scene soft = between_stops();
  soft.stops.stiffness_lower = soft.stops.stiffness_upper = 10;
  EXPECT_EQ(BeyondContact(soft, period)({1 - h, 1.0}).v, 1.0);  // whose velocity doesn't jump
}

// Both momenta change by the same impulse: x' + eps y' is kept, with y' = x' + z'.
TEST(BeyondContact, takes_both_masses_through_an_impact_on_a_wall) {
  Scene scene;
  scene.loose = {.ratio = 0.25, .lower = -0.5, .upper = 0.5, .restitution_lower = 0.6, .restitution_upper = 0.6};
  const SectionNumbers after = BeyondContact(scene, period)({0.1, 0.3, 0.5 - 2 * h, 2.0});
  EXPECT_DOUBLE_EQ(after.w, -1.2);
  EXPECT_NEAR(after.v + 0.25 * (after.v + after.w), 0.3 + 0.25 * (0.3 + 2.0), 1e-15);
  EXPECT_NEAR(after.z - 0.5, 0.6 * 2 * h, 1e-15);
  EXPECT_NEAR(after.x - 0.1, (0.3 - after.v) * h, 1e-16);
}

TEST(BeyondContact, both_sides_of_an_impact_are_one_repeat) {
  const BeyondContact beyond(between_stops(), period);
  RepeatFinder as_they_are(1e-12), compared(1e-12);
  std::size_t raw = 0, n = 0;
  for (int section = 0; section < 40 && n == 0; ++section) {
    const bool before = section % 3 == 0;  // as rounding has it
    const double x = before ? 1 - 1e-15 : 1.0, v = before ? 2.0 : -1.6;
    raw = std::max(raw, as_they_are.add(x, v, -1.0));
    const SectionNumbers at = beyond({x, v});
    n = compared.add(at.x, at.v, -1.0);
  }
  EXPECT_EQ(n, 1u);
  EXPECT_NE(raw, 1u);
}

TEST(RepeatFinder, judges_by_the_size_of_the_motion) {
  std::size_t of_state = 0, of_motion = 0;
  RepeatFinder by_state(1e-12), by_motion(1e-12);
  for (int section = 0; section < 40; ++section) {
    const double x = section % 2 == 0 ? 5.6704772410577e-16 : 5.670477237083548e-16;  // which sticks beside 0
    of_state = std::max(of_state, by_state.add(x, 0.0, -1.0));
    if (const std::size_t n = by_motion.add(x, 0.0, -1.0, 2.3); of_motion == 0) of_motion = n;
  }
  EXPECT_EQ(of_state, 2u);
  EXPECT_EQ(of_motion, 1u);
}

// A start far away is forgotten as fast as the size of a motion fades.
TEST(RepeatFinder, forgets_the_size_of_an_early_motion) {
  RepeatFinder repeat(1e-12);
  std::size_t n = repeat.add(1.0, 1.0, -0.1, 1e9);
  for (int section = 1; section < 600 && n == 0; ++section) {
    const double left = 1e-3 * std::pow(0.8, section);
    n = repeat.add(1.0 + left, 0.0, -0.1, 1.0);
    if (n > 0) {
      EXPECT_LT(left, 1e-12);
    }
  }
  EXPECT_EQ(n, 1u);
}

}  // namespace
}  // namespace clatter::steady::contact_at_section_test
