// Dry friction by time stepping: an impulse that takes the velocity to 0 and holds it there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "stepping/moreau.hpp"
#include "support/friction_scenes.hpp"
#include "support/methods.hpp"

namespace clatter::stepping::moreau_friction_test {
namespace {

using accuracy::Event;
using accuracy::RunRecord;

constexpr double pi_ = std::numbers::pi;

std::vector<Event> those(const RunRecord& record, Event::Kind kind) {
  std::vector<Event> found;
  std::ranges::copy_if(accuracy::with_rests_joined(record.events), std::back_inserter(found),
                       [kind](const Event& event) { return event.kind == kind; });
  return found;
}

RunRecord run_of(point::Problem scene, double steps, double duration, double theta = 0.5) {
  scene.integration.method = Method::moreau, scene.integration.step = 1 / steps, scene.integration.theta = theta;
  return support::record_by<Moreau>(scene, duration);
}

/// The length of a step.
double step_of(const point::Problem& scene, double steps) { return period_of(scene.oscillator) / steps; }

TEST(MoreauFriction, free_motion_loses_four_times_the_friction_a_turn_and_stops) {
  const point::Problem scene = support::rubbing_from(5.3, {1, 1});
  for (const double theta : {0.5, 0.7, 1.0})
    for (const double steps : {300.0, 1000.0, 30000.0}) {
      const RunRecord record = run_of(scene, steps, 20, theta);
      const auto reversals = those(record, Event::Kind::reversal), sticks = those(record, Event::Kind::stick);
      const double step = step_of(scene, steps);
      ASSERT_EQ(reversals.size(), 2u) << theta << ", " << steps;
      ASSERT_EQ(sticks.size(), 1u);
      const double places = (theta == 0.5 ? 1.0 : 3 * pi_ * 5.3) * step;  // of first order in the step beside 1/2
      EXPECT_NEAR(reversals[0].place, -3.3, places);
      EXPECT_NEAR(reversals[1].place, 1.3, places);
      EXPECT_NEAR(sticks[0].place, 0.7, places);
      EXPECT_NEAR(sticks[0].time, 3 * pi_, 4 * step);  // each end of a slip falls on a step
      EXPECT_NEAR(sticks[0].end(), 20, 1e-13);
      EXPECT_EQ(record.v, 0);
    }
}

/// It turns at -3.3, and would at 1.3 slide back, but static friction holds it there.
TEST(MoreauFriction, the_static_level_holds_a_mass_that_comes_to_a_halt_wherever_in_a_step_it_does) {
  const point::Problem scene = support::rubbing_from(5.3, {1, 2.5});
  for (int steps = 1000; steps < 1100; ++steps) {
    const RunRecord record = run_of(scene, steps, 20);
    EXPECT_EQ(those(record, Event::Kind::reversal).size(), 1u) << steps;
    const auto sticks = those(record, Event::Kind::stick);
    ASSERT_EQ(sticks.size(), 1u) << steps;
    EXPECT_NEAR(sticks[0].place, 1.3, step_of(scene, steps));
    EXPECT_NEAR(record.x, 1.3, step_of(scene, steps));
  }
}

TEST(MoreauFriction, a_stick_ends_with_the_step_in_which_the_force_passes_the_static_level) {
  point::Problem scene = support::rubbing_from(0.1, {0.3, 0.6});
  scene.oscillator.forcing = 1, scene.oscillator.frequency = 0.7;
  for (int steps = 1000; steps < 1100; ++steps) {
    const auto sticks = those(run_of(scene, steps, 2), Event::Kind::stick);
    ASSERT_EQ(sticks.size(), 1u);
    EXPECT_NEAR(sticks[0].end(), std::asin(0.7) / 0.7, step_of(scene, steps));
  }
}

TEST(MoreauFriction, a_mass_that_a_stick_or_a_rest_has_ended_does_not_turn_back_in_addition) {
  const point::Problem scene = support::rubbing_with_a_stick();
  const double duration = 30 * 2 * pi_ / 1.3;
  const RunRecord exact = accuracy::record_of(scene, duration), record = run_of(scene, 20000, duration);
  for (const Event::Kind kind : {Event::Kind::impact, Event::Kind::stick, Event::Kind::reversal, Event::Kind::rest})
    EXPECT_EQ(those(record, kind).size(), those(exact, kind).size()) << static_cast<int>(kind);
  point::Problem resting = support::scene_of({.damping = 0.1, .forcing = 1, .frequency = 0.5}, -0.5, 0.5, 0.0);
  resting.friction = {0.05, 0.05};
  EXPECT_GT(those(run_of(resting, 5000, 60), Event::Kind::rest).size(), 5u);
  EXPECT_EQ(those(run_of(resting, 5000, 60), Event::Kind::reversal).size(), 0u);
}

TEST(MoreauFriction, settled_motion_has_the_known_impacts_and_the_known_stick_to_the_step) {
  const point::Problem scene = support::rubbing_with_a_stick();
  std::vector<double> steps, errors;
  for (const double count : {1000.0, 3000.0, 10000.0, 30000.0, 100000.0}) {
    const RunRecord record = run_of(scene, count, 40 * 2 * pi_ / 1.3);
    const auto impacts = those(record, Event::Kind::impact), sticks = those(record, Event::Kind::stick);
    ASSERT_EQ(impacts.size(), 80u);
    ASSERT_GT(sticks.size(), 10u);
    const Event& stick = sticks[sticks.size() - 2];
    double error = std::max(std::abs(stick.length - 0.315340026143191), std::abs(stick.place + 0.327636229491487));
    for (const std::size_t i : {78u, 79u}) {
      const double known = impacts[i].side == Side::upper ? 0.940532086164330 : 0.718708034646616;
      error = std::max(error, std::abs(impacts[i].speed() - known));
    }
    steps.push_back(1 / count), errors.push_back(error);
    EXPECT_LT(error, 4 * step_of(scene, count));  // impacts, a halt and a release fall on steps
  }
  EXPECT_NEAR(support::order_of(steps, errors), 1, 0.3);
}

TEST(MoreauFriction, holds_a_mass_on_a_rigid_stop_as_rest_up_to_the_static_level) {
  point::Problem scene = support::scene_of({.forcing = 1, .load = -0.2, .stiffness = 0}, 0, 10, 0.5);
  scene.start.phase = -1, scene.friction = {0.1, 0.3};
  const double release = std::asin(0.5) + 1;
  for (const double start : {0.0, -1e-9}) {  // on it, or beyond it as a step may leave it
    scene.start.displacement = start;
    const RunRecord record = run_of(scene, 1000, 1.8);
    const auto rests = those(record, Event::Kind::rest);
    ASSERT_EQ(rests.size(), 1u);
    EXPECT_EQ(rests[0].side, Side::lower);
    EXPECT_NEAR(rests[0].end(), release, step_of(scene, 1000));
    EXPECT_EQ(those(record, Event::Kind::stick).size(), 0u);
    EXPECT_GT(record.v, 0);
  }
}

TEST(MoreauFriction, holds_a_mass_inside_a_soft_stop_up_to_the_static_level) {
  point::Problem scene = support::scene_of({.stiffness = 0}, -10, 0, 1);
  scene.stops.stiffness_upper = 100, scene.friction = {0.3, 0.5};
  scene.start.displacement = 0.0049;
  const RunRecord held = run_of(scene, 1000, 10);
  EXPECT_EQ(held.x, 0.0049);
  EXPECT_EQ(those(held, Event::Kind::stick).size(), 1u);
  scene.start.displacement = 0.0051;
  EXPECT_LT(run_of(scene, 1000, 0.1).v, 0);
}

/// Into the stop and out of it: v^2 = kappa d^2 + 2 mu d at depth d, and kappa d^2 - 2 mu d is left.
TEST(MoreauFriction, loses_the_work_of_friction_inside_a_soft_stop) {
  point::Problem scene = support::scene_of({.stiffness = 0}, -10, 0, 1);
  scene.stops.stiffness_upper = 100, scene.friction = {0.5, 0.5}, scene.start.velocity = 1;
  const double depth = (std::sqrt(0.25 + 100) - 0.5) / 100, back = std::sqrt(1 - 2 * depth);
  std::vector<double> steps, errors;
  for (const double count : {1e3, 1e4, 1e5}) {
    const RunRecord record = run_of(scene, count, 0.4);
    const auto reversals = those(record, Event::Kind::reversal);
    ASSERT_EQ(reversals.size(), 1u);
    EXPECT_NEAR(reversals[0].place, depth, step_of(scene, count));
    // it left the stop some time ago, and has rubbed since
    const double error = std::abs(std::sqrt(record.v * record.v + 2 * 0.5 * -record.x) - back);
    steps.push_back(1 / count), errors.push_back(error);
  }
  EXPECT_LT(errors.back(), 1e-3);
  EXPECT_GT(support::order_of(steps, errors), 0.8);
}

}  // namespace
}  // namespace clatter::stepping::moreau_friction_test
