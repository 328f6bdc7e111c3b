// Dry friction where rounding decides: whether a reversal sticks, whether a force lets a mass go.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hard/measure.hpp"

namespace clatter::hard::dry_friction_test {
namespace {

using accuracy::Event;

std::vector<Event> those(const std::string& what, Event::Kind kind) {
  const Case& one = case_of("dry_friction", what);
  std::vector<Event> found;
  std::ranges::copy_if(accuracy::with_rests_joined(accuracy::record_of(one.scene, one.duration).events),
                       std::back_inserter(found), [kind](const Event& event) { return event.kind == kind; });
  return found;
}

TEST(DryFriction, agrees_with_fifty_digits) { expect_agreement("dry_friction"); }

TEST(DryFriction, sticks_at_the_first_turn_within_the_static_level) {
  for (const auto& [what, turns] : {std::pair{"turn 200 just sticks", 200}, {"turn 200 just doesn't", 201}}) {
    const auto sticks = those(what, Event::Kind::stick);
    ASSERT_EQ(sticks.size(), 1u) << what;
    EXPECT_EQ(those(what, Event::Kind::reversal).size(), static_cast<std::size_t>(turns - 1)) << what;
    EXPECT_NEAR(std::abs(sticks[0].place), std::abs(401.5 - 2 * turns), 6e-12) << what;  // 200 roundings of 401.5
    EXPECT_NEAR(sticks[0].time, turns * std::numbers::pi, 1e-12) << what;
  }
}

TEST(DryFriction, lets_go_the_square_root_of_the_excess_before_the_force_is_greatest) {
  for (const char* what :
       {"let go at |f| = level (1 + 1e-9)", "let go at |f| = level (1 + 2 ulps)", "the same, mu = level"}) {
    const Scene& scene = case_of("dry_friction", what).scene;
    const Event first = those(what, Event::Kind::stick).at(0);
    EXPECT_EQ(first.time, 0);
    EXPECT_NEAR(first.length * scene.oscillator.frequency, std::asin(scene.friction.static_level),
                4 * epsilon<double>())
        << what;
  }
}

TEST(DryFriction, holds_a_mass_for_good_if_no_force_passes_its_static_level) {
  const char* const what = "held at |f| = level (1 - 2 ulps)";
  const auto sticks = those(what, Event::Kind::stick);
  ASSERT_EQ(sticks.size(), 1u);
  EXPECT_EQ(sticks[0].length, case_of("dry_friction", what).duration);
}

/// Near the stop it is pressed by a = load - k xs = 0.5, and a flight leaves (a - mu)/(a + mu) of its energy.
TEST(DryFriction, brings_elastic_chatter_to_rest) {
  const char* const what = "chatter to rest, R = 1";
  const auto impacts = those(what, Event::Kind::impact);
  ASSERT_GT(impacts.size(), 100u);
  ASSERT_EQ(those(what, Event::Kind::rest).size(), 1u);
  const double rho = std::sqrt(0.48 / 0.52);
  for (std::size_t i = impacts.size() - 50; i < impacts.size(); ++i)
    EXPECT_NEAR(impacts[i].speed() / impacts[i - 1].speed(), rho,
                impacts[i - 1].speed());  // the height is of order v^2
}

TEST(DryFriction, leaves_a_mass_off_the_stop_that_it_chatters_on_if_its_static_level_is_above_what_presses_it) {
  for (const char* what : {"chatter into a stick", "stays off the stop"}) {
    const auto sticks = those(what, Event::Kind::stick);
    ASSERT_FALSE(sticks.empty()) << what;
    EXPECT_LT(sticks.back().place, case_of("dry_friction", what).scene.stops.upper) << what;
    EXPECT_GT(those(what, Event::Kind::impact).size(), 0u) << what;
  }
}

}  // namespace
}  // namespace clatter::hard::dry_friction_test
