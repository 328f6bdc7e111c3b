// A loose mass in a housing that feels its impacts: closed forms, laws of conservation, and limits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/given_scene.hpp"
#include "support/loose_scenes.hpp"

namespace clatter::stepping::loose_mass_test {
namespace {

using support::loose_scene, support::LooseRun, support::observed, support::run_loose;

constexpr double pi_ = std::numbers::pi;

/// Masri & Caughey 1966: the steady motion with two impacts a period, half a period apart.
TEST(LooseMass, an_impact_damper_settles_on_the_closed_form) {
  const auto result = observed(support::impact_damper());
  ASSERT_EQ(result.status, steady::Status::periodic);
  EXPECT_EQ(result.period_ratio, 1);
  EXPECT_EQ(result.impact_word, "LU");
  EXPECT_EQ(result.symmetric, 1);
  ASSERT_EQ(result.log.size(), 2u);
  for (const auto& impact : result.log) {
    EXPECT_NEAR(std::abs(impact.before), support::impact_damper_speed, 1e-12);
    EXPECT_NEAR(std::abs(impact.after), 0.8 * support::impact_damper_speed, 1e-12);
  }
  EXPECT_NEAR(result.z_max, 0.4, 1e-15);
  EXPECT_NEAR(result.z_min, -0.4, 1e-15);
  EXPECT_LT(std::abs(result.energy_residual), 1e-15);
}

TEST(LooseMass, the_main_mass_is_where_the_closed_form_has_it) {
  const LooseRun run = run_loose(support::impact_damper(), 3000 * 2 * pi_);
  ASSERT_EQ(run.outcome, Outcome::completed);
  ASSERT_GT(run.record.strikes.size(), 5000u);
  for (std::size_t i = run.record.strikes.size() - 4; i < run.record.strikes.size(); ++i) {
    const motion::Event& strike = run.record.strikes[i];
    EXPECT_NEAR(std::abs(strike.main.place), 0.180585488325042, 1e-12);
    EXPECT_NEAR(std::abs(strike.main.before), 0.0492816268556546, 1e-12);
    EXPECT_NEAR(std::abs(strike.main.after), 0.034497138798958, 1e-12);
    EXPECT_NEAR(std::abs(strike.before), support::impact_damper_speed, 1e-12);
  }
}

/// The law of impact, by the velocities of both masses.
TEST(LooseMass, impacts_keep_the_momentum_and_lose_their_share_of_the_energy) {
  const double eps = 0.3, R = 0.7;
  point::Problem scene = loose_scene(eps, 0.02, 0.4, 1.7, 0.3, R);
  scene.loose.velocity = 0.2, scene.loose.load = 0.05;
  const LooseRun run = run_loose(scene, 300);
  ASSERT_GT(run.record.strikes.size(), 100u);
  for (const motion::Event& strike : run.record.strikes) {
    const double y = strike.main.before + strike.before, y_after = strike.main.after + strike.after;
    EXPECT_NEAR(strike.main.before + eps * y, strike.main.after + eps * y_after, 1e-13);
    EXPECT_NEAR(strike.after, -R * strike.before, 1e-16);
    const double before = strike.main.before * strike.main.before + eps * y * y,
                 after = strike.main.after * strike.main.after + eps * y_after * y_after;
    EXPECT_NEAR((before - after) / 2, eps * (1 - R * R) * strike.before * strike.before / (2 * (1 + eps)), 1e-13);
  }
}

TEST(LooseMass, without_losses_the_energy_stays_over_a_hundred_thousand_impacts) {
  const double eps = 0.4;
  point::Problem scene = loose_scene(eps, 0, 0, 1, 0.05, 1);
  scene.start.velocity = 0.3, scene.loose.velocity = 0.2;
  const LooseRun run = run_loose(scene, 80000);
  ASSERT_EQ(run.outcome, Outcome::completed);
  EXPECT_GT(run.record.strikes.size(), 1e5);
  const auto energy = [eps](double x, double v, double y) { return (v * v + x * x + eps * y * y) / 2; };
  EXPECT_NEAR(energy(run.end.x, run.end.v, run.end.v + run.w) / energy(0, 0.3, 0.5), 1, 1e-11);
}

/// A mass of almost nothing in a housing that moves as the response to the force is a ball between shaken walls.
TEST(LooseMass, a_mass_of_nothing_moves_like_a_ball_between_shaken_stops) {
  const double b = 0.3, nu = 1.4, gap = 0.5, R = 0.8;
  // x = b sin(nu tau) for all time: the force that makes it, and the start on it
  point::Problem carried = loose_scene(1e-14, 0, b * (1 - nu * nu), nu, gap, R);
  carried.start.velocity = b * nu, carried.loose.velocity = 0.05;
  point::Problem ball;
  ball.oscillator = {.frequency = nu, .stiffness = 0};
  ball.stops = {-gap, gap, R, R};
  ball.start.velocity = 0.05, ball.shaking.stops = b;
  static_cast<Scene&>(ball) = in_shaken_frame(ball);
  ball.time.mode = steady::Mode::transient, ball.time.duration = 60, ball.observe.impact_log = true;
  point::ThreadScratch scratch;
  const auto reference = run_point(ball, scratch);
  const LooseRun run = run_loose(carried, 60);
  ASSERT_GT(reference.log.size(), 20u);
  ASSERT_EQ(run.record.strikes.size(), reference.log.size());
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(run.record.strikes[i].time, reference.log[i].time, 1e-9) << i;
    EXPECT_NEAR(run.record.strikes[i].before, reference.log[i].before, 1e-9) << i;
  }
}

/// In a housing without room the two masses are one, to first order in the room.
TEST(LooseMass, without_room_it_is_a_part_of_the_main_mass) {
  const double eps = 0.25, h = 0.05, f = 0.5, nu = 1.3, duration = 40;
  point::Problem one;
  one.oscillator = {h / (1 + eps), f / (1 + eps), nu, 0, 1 / (1 + eps)};
  one.time.mode = steady::Mode::transient, one.time.duration = duration;
  point::ThreadScratch scratch;
  const double x = run_point(one, scratch).end.displacement;
  double last = 0;
  for (const double gap : {1e-3, 1e-5, 1e-7}) {
    const LooseRun run = run_loose(loose_scene(eps, h, f, nu, gap, 0.4), duration);
    ASSERT_EQ(run.outcome, Outcome::completed) << gap;
    EXPECT_FALSE(run.record.holds.empty()) << gap;
    last = std::abs(run.end.x - x);
    EXPECT_LT(last, 10 * gap) << gap;
  }
  EXPECT_LT(last, 1e-6);
}

/// A mass pressed onto a wall moves with the main mass until that would have to pull it.
TEST(LooseMass, a_wall_lets_go_where_it_would_have_to_pull) {
  const double eps = 0.5, f = 0.4, nu = 0.6, g = -0.3;
  point::Problem scene = loose_scene(eps, 0.1, f, nu, 1, 0.3);
  scene.loose.load = g, scene.loose.lower = -0.1;
  const LooseRun run = run_loose(scene, 400);
  ASSERT_GT(run.record.presses.size(), 5u);
  ASSERT_GT(run.record.holds.size(), 5u);
  for (const motion::Event& press : run.record.presses) EXPECT_LT(std::abs(press.before), 1e-14);
  for (const motion::Event& hold : run.record.holds) {
    EXPECT_EQ(hold.place, hold.side == Side::upper ? 1 : -0.1);
    EXPECT_GE(hold.length, 0);
  }
}

/// Under its own load, on a housing that stands, it bounces like a ball: both are closed forms.
TEST(LooseMass, on_a_housing_that_stands_it_bounces_like_a_ball) {
  const double g = 0.8, R = 0.6, height = 0.5;
  point::Problem scene = loose_scene(1e-16, 0, 0, 1, 1, R);
  scene.loose.load = -g, scene.loose.lower = -height;
  const LooseRun run = run_loose(scene, 20);
  const double first = std::sqrt(2 * height / g);
  ASSERT_GT(run.record.strikes.size(), 30u);
  double time = first, speed = std::sqrt(2 * g * height);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_NEAR(run.record.strikes[i].time, time, 1e-14 * 8);
    EXPECT_NEAR(run.record.strikes[i].before / -speed, 1, 1e-13);
    speed *= R, time += 2 * speed / g;
  }
  ASSERT_EQ(run.record.presses.size(), 1u);
  EXPECT_NEAR(run.record.presses[0].time, first * (1 + R) / (1 - R), 1e-13);
  EXPECT_EQ(run.z, -height);
  EXPECT_EQ(run.w, 0);
}

/// The mirror image, half a forcing period later, is the same motion to the last bit.
TEST(LooseMass, mirrored_scenes_move_as_mirror_images) {
  point::Problem scene = loose_scene(0.1, 0.03, 0.5, 1.2, 0.6, 0.7), mirror = scene;
  scene.start = {0.1, -0.2, 0.4}, scene.loose.place = 0.2, scene.loose.velocity = 0.15;
  scene.oscillator.load = 0.05, scene.loose.load = 0.02;
  mirror.oscillator.forcing = -0.5, mirror.oscillator.load = -0.05;
  mirror.start = {-0.1, 0.2, 0.4}, mirror.loose.place = -0.2, mirror.loose.velocity = -0.15, mirror.loose.load = -0.02;
  const LooseRun run = run_loose(scene, 60), other = run_loose(mirror, 60);
  ASSERT_GT(run.record.strikes.size(), 20u);
  EXPECT_EQ(run.end.x, -other.end.x);
  EXPECT_EQ(run.end.v, -other.end.v);
  EXPECT_EQ(run.z, -other.z);
  EXPECT_EQ(run.w, -other.w);
}

TEST(LooseMass, lengths_scale) {
  point::Problem scene = loose_scene(0.1, 0.03, 0.5, 1.2, 0.6, 0.7), larger = scene;
  larger.oscillator.forcing *= 4, larger.loose.lower *= 4, larger.loose.upper *= 4;
  const LooseRun run = run_loose(scene, 60), other = run_loose(larger, 60);
  EXPECT_EQ(4 * run.end.x, other.end.x);
  EXPECT_EQ(4 * run.z, other.z);
}

/// A machine in SI is computed as the scene without units that it is.
TEST(LooseMass, of_a_machine_is_that_of_its_scene_without_units) {
  const point::Problem scene = loose_scene(0.1, 0.03, 0.5, 1.2, 0.6, 0.7);
  constexpr double m = 0.25, K = 16;  // a unit of time is 1/8 s, exactly
  GivenScene machine(scene);
  machine.is_si = true, machine.mass = m;
  machine.oscillator = {0, 0.5 * K, 1.2 * 8 / (2 * pi_), 0, K}, machine.damper = 2 * 0.03 * std::sqrt(K * m);
  machine.loose.ratio = 0.1 * m, machine.loose.load = 0.05 * 64, machine.loose.velocity = 0.2 * 8;
  const auto [computed_scene, units] = computed(machine);
  LooseMass known{.ratio = 0.1,
                  .lower = -0.6,
                  .upper = 0.6,
                  .restitution_lower = 0.7,
                  .restitution_upper = 0.7,
                  .load = 0.05,
                  .velocity = 0.2};
  known.restitution_lower.scale_speeds(units.time), known.restitution_upper.scale_speeds(units.time);
  EXPECT_EQ(computed_scene.loose, known);
  EXPECT_NEAR(computed_scene.oscillator.damping, 0.03, 1e-17);
  EXPECT_NEAR(computed_scene.oscillator.frequency, 1.2, 1e-15);
  EXPECT_EQ(units.time, 1 / 8.0);
}

/// A load on the main mass moves all but the places in the housing.
TEST(LooseMass, a_load_shifts_the_main_mass) {
  point::Problem scene = loose_scene(0.1, 0.03, 0.5, 1.2, 0.6, 0.7), loaded = scene;
  scene.loose.velocity = loaded.loose.velocity = 0.1;
  loaded.oscillator.load = 0.25, loaded.start.displacement = 0.25;
  const LooseRun run = run_loose(scene, 30), other = run_loose(loaded, 30);
  ASSERT_EQ(run.record.strikes.size(), other.record.strikes.size());
  EXPECT_NEAR(run.end.x + 0.25, other.end.x, 1e-11);
  EXPECT_NEAR(run.z, other.z, 1e-11);
}

/// A shaken base is a force on the ground, and what it carries is the same.
TEST(LooseMass, a_shaken_base_is_a_force_of_spring_and_damper) {
  const double h = 0.07, nu = 1.2, b = 0.3;
  point::Problem forced = loose_scene(0.1, h, b * std::hypot(1, 2 * h * nu), nu, 0.6, 0.7), shaken = forced;
  shaken.oscillator.forcing = 0, shaken.shaking.base = b;
  forced.start.phase = std::atan(2 * h * nu), forced.start.velocity = b * nu;
  static_cast<Scene&>(shaken) = in_shaken_frame(shaken);
  const LooseRun run = run_loose(forced, 40), other = run_loose(shaken, 40);
  ASSERT_GT(run.record.strikes.size(), 10u);
  EXPECT_NEAR(run.end.x, other.end.x, 1e-10);
  EXPECT_NEAR(run.z, other.z, 1e-10);
}

/// A mass that stands while its housing swings within the room is never struck; the least drift strikes in the end.
TEST(LooseMass, only_a_mass_that_stands_stays_clear_of_the_walls) {
  point::Problem scene = loose_scene(0.02, 0.05, 0.02, 1, 0.4, 0.8);
  EXPECT_TRUE(run_loose(scene, 20000).record.strikes.empty());
  scene.loose.velocity = 1e-4;
  const LooseRun run = run_loose(scene, 20000);
  ASSERT_FALSE(run.record.strikes.empty());
  EXPECT_GT(run.record.strikes.back().time, 19900);
}

TEST(LooseMass, one_that_leaves_through_the_side_without_a_wall_escapes) {
  point::Problem scene = loose_scene(0.05, 0.02, 0.3, 1.3, 0.5, 0.6);
  scene.loose.upper = std::numeric_limits<double>::infinity(), scene.loose.velocity = 3;
  EXPECT_EQ(observed(scene).status, steady::Status::escaped);
  scene.loose.load = -0.2;
  EXPECT_NE(observed(scene).status, steady::Status::escaped);
}

/// The ledger closes, with a shaken base and presses, too.
TEST(LooseMass, the_energy_ledger_closes) {
  point::Problem scene = loose_scene(0.3, 0.04, 0.3, 0.8, 0.4, 0.5);
  scene.oscillator.load = 0.1, scene.loose.load = -0.2, scene.shaking.base = 0.2, scene.shaking.phase = 0.7;
  static_cast<Scene&>(scene) = in_shaken_frame(scene);
  scene.time.mode = steady::Mode::transient, scene.time.duration = 100;
  const auto result = observed(scene);
  ASSERT_EQ(result.status, steady::Status::transient);
  EXPECT_GT(result.rest_fraction[0], 0.05);
  EXPECT_GT(result.loss_impact[0], 0.01);
  EXPECT_LT(std::abs(result.energy_residual), 1e-12);
}

}  // namespace
}  // namespace clatter::stepping::loose_mass_test
