// Dry friction by Dormand and Prince's method, which shares the phases of the exact one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "point/point.hpp"
#include "stepping/dormand_prince.hpp"
#include "support/deviation.hpp"
#include "support/friction_scenes.hpp"
#include "support/methods.hpp"

namespace clatter::stepping::dormand_prince_friction_test {
namespace {

using accuracy::Event;
using accuracy::RunRecord;

constexpr double pi_ = std::numbers::pi;

point::Problem with_tolerance(point::Problem scene, double tolerance) {
  scene.integration.method = Method::dopri5, scene.integration.tolerance = tolerance;
  return scene;
}

std::vector<Event> those(const RunRecord& record, Event::Kind kind) {
  std::vector<Event> found;
  std::ranges::copy_if(accuracy::with_rests_joined(record.events), std::back_inserter(found),
                       [kind](const Event& event) { return event.kind == kind; });
  return found;
}

RunRecord run_of(const point::Problem& scene, double tolerance, double duration) {
  return support::record_by<DormandPrince>(with_tolerance(scene, tolerance), duration);
}

TEST(DormandPrinceFriction, free_motion_loses_four_times_the_friction_a_turn_and_stops) {
  point::Problem scene = support::rubbing_from(5.3, {1, 1});
  scene.stops.lower = -5.5, scene.stops.upper = 5.5;  // not met
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    const RunRecord record = run_of(scene, tolerance, 20);
    const auto reversals = those(record, Event::Kind::reversal), sticks = those(record, Event::Kind::stick);
    ASSERT_EQ(reversals.size(), 2u);
    ASSERT_EQ(sticks.size(), 1u);
    const double steps = 5.3 * 50;  // of each of them the error is about the tolerance
    EXPECT_NEAR(reversals[0].place, -3.3, steps * tolerance);
    EXPECT_NEAR(reversals[1].place, 1.3, steps * tolerance);
    EXPECT_NEAR(sticks[0].place, 0.7, steps * tolerance);
    EXPECT_NEAR(sticks[0].time, 3 * pi_, steps * tolerance);
    EXPECT_EQ(record.v, 0);
  }
}

/// The names say of what.
struct Named {
  const char* name;
  point::Problem scene;
};

std::vector<Named> every_kind() {
  const double none = std::numeric_limits<double>::infinity();
  std::vector<Named> scenes{
      {"a stick a period", support::rubbing_with_a_stick()},
      {"reversals", support::scene_of({.damping = 0.05, .forcing = 1, .frequency = 0.8}, -none, none, 1)},
      {"static far above sliding", support::scene_of({.damping = 0.05, .forcing = 1, .frequency = 0.3}, -9, 9, 1)},
      {"rests and sticks", support::scene_of({.damping = 0.1, .forcing = 1, .frequency = 0.5}, -0.5, 0.5, 0.5)},
      {"chatter into a stick", support::scene_of({.load = -2, .stiffness = 0}, 0, 10, 0.9)},
      {"elastic chatter", support::scene_of({.load = -2, .stiffness = 0}, 0, 10, 1)},
      {"soft stops", support::scene_of({.damping = 0.05, .forcing = 1, .frequency = 0.8}, -0.4, 0.4, 1)}};
  scenes[1].scene.friction = {0.3, 0.3};
  scenes[2].scene.friction = {0.02, 0.9};
  scenes[3].scene.friction = {0.1, 0.2};
  scenes[4].scene.friction = {0.5, 2.5}, scenes[4].scene.start.velocity = 1;
  scenes[5].scene.friction = {0.5, 0.5}, scenes[5].scene.start.velocity = 1;
  scenes[6].scene.friction = {0.2, 0.3};
  scenes[6].scene.stops.stiffness_lower = scenes[6].scene.stops.stiffness_upper = 30;
  scenes[6].scene.stops.damping_upper = 0.2;
  return scenes;
}

TEST(DormandPrinceFriction, of_every_kind_is_that_of_fifty_digits) {
  for (const auto& [name, scene] : every_kind()) {
    const RunRecord reference = accuracy::reference_of(scene, 25);
    const double sensitive = std::max(1.0, support::conditioning(scene, reference) / epsilon<double>());
    for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
      const support::Deviation d = support::deviation(run_of(scene, tolerance, 25), reference);
      EXPECT_TRUE(d.same_events) << name << ", " << tolerance << ": " << d.difference;
      // every step errs by about the tolerance, which the motion multiplies as much as an ulp of its inputs
      EXPECT_LT(d.largest(), 4 * tolerance * sensitive) << name << ", " << tolerance;
    }
  }
}

/// Let go with no acceleration, the mass moves by less than the error of a step's polynomial at first.
TEST(DormandPrinceFriction, a_release_without_acceleration_is_one) {
  point::Problem scene = support::rubbing_from(0.1, {0.6, 0.6});
  scene.oscillator.forcing = 1, scene.oscillator.frequency = 0.7;
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const RunRecord record = run_of(scene, tolerance, 4);
    ASSERT_EQ(record.events.size(), 2u) << tolerance;  // held again later
    EXPECT_EQ(record.events[0].kind, Event::Kind::stick);
    EXPECT_NEAR(record.events[0].end(), std::asin(0.7) / 0.7, 1e-15 * 2);
    EXPECT_EQ(record.events[1].kind, Event::Kind::stick);
    EXPECT_GT(record.events[1].place, 0.1);
  }
}

TEST(DormandPrinceFriction, a_mass_let_go_into_the_soft_stop_that_it_is_on_does_not_strike_it) {
  for (const double kinetic : {0.3, 0.6}) {
    point::Problem scene = support::scene_of({.forcing = 1, .frequency = 0.7}, -1, 0.1, 1);
    scene.stops.stiffness_upper = 50;
    scene.friction = {kinetic, 0.6}, scene.start.displacement = 0.1;
    support::Recorder record;
    const RunRecord run = support::run_by<DormandPrince>(with_tolerance(scene, 1e-10), 3, record);
    EXPECT_TRUE(record.touches.empty());
    EXPECT_GT(run.x, 0.1);
  }
}

TEST(DormandPrinceFriction, settles_on_the_motion_with_a_stick_to_its_tolerance) {
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    point::Problem problem = with_tolerance(support::rubbing_with_a_stick(), tolerance);
    problem.observe.impacts = problem.observe.of_sticks = problem.observe.stability = true;
    problem.time.tolerance = std::max(tolerance, 1e-11);
    point::ThreadScratch scratch;
    const point::PointResult result = run_point(problem, scratch);
    EXPECT_EQ(result.status, steady::Status::periodic);
    EXPECT_EQ(result.observed_turns, 1);
    const double allowed = 100 * tolerance;  // some hundred steps a period
    EXPECT_NEAR(result.impact_speed[1], 0.940532086164330, allowed);
    EXPECT_NEAR(result.impact_speed[0], 0.718708034646616, allowed);
    EXPECT_NEAR(result.stick_fraction, 0.315340026143191 / (2 * pi_ / 1.3), allowed);
    EXPECT_NEAR(result.multiplier_re[0], 0.267959696315445, allowed);
    EXPECT_EQ(result.multiplier_re[1], 0);
  }
}

TEST(DormandPrinceFriction, error_falls_with_the_tolerance) {
  const double duration = 30 * 2 * pi_ / 1.3;
  const RunRecord exact = accuracy::record_of(support::rubbing_with_a_stick(), duration);
  std::vector<double> tolerances, errors;
  for (double tolerance = 1e-4; tolerance > 1e-11; tolerance /= 10) {
    const support::Deviation d =
        support::deviation(run_of(support::rubbing_with_a_stick(), tolerance, duration), exact);
    ASSERT_TRUE(d.same_events) << d.difference;
    tolerances.push_back(tolerance), errors.push_back(d.largest());
  }
  EXPECT_NEAR(support::order_of(tolerances, errors), 1, 0.1);
  EXPECT_LT(errors.back(), 1e-10);
}

}  // namespace
}  // namespace clatter::stepping::dormand_prince_friction_test
