// A loose mass that rubs on its housing: closed forms, laws of conservation, and limits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "stepping/dormand_prince.hpp"
#include "support/deviation.hpp"
#include "support/loose_scenes.hpp"
#include "support/methods.hpp"

namespace clatter::stepping::loose_friction_test {
namespace {

using support::loose_scene, support::LooseRun, support::run_loose;

constexpr double pi_ = std::numbers::pi;

/// With friction of one level, or of two.
[[nodiscard]] point::Problem rubbing(point::Problem scene, double kinetic, double level = 0) {
  scene.loose.friction = kinetic, scene.loose.friction_static = std::max(kinetic, level);
  return scene;
}
/// The steady motion of a scene.
[[nodiscard]] point::PointResult observed(point::Problem scene) {
  scene.observe.extrema = scene.observe.word = scene.observe.period = scene.observe.energy = true;
  point::ThreadScratch scratch;
  return run_point(scene, scratch);
}
/// A main mass without spring, damper and force.
[[nodiscard]] point::Problem free_pair(double eps, double R) {
  point::Problem scene = loose_scene(eps, 0, 0, 1, 0.5, R);
  scene.oscillator.stiffness = 0;
  return scene;
}

/// On a main mass without a spring both have the acceleration f sin(nu tau)/(1 + eps) until that is F/eps.
TEST(LooseFriction, holds_until_both_are_accelerated_by_more_than_its_level) {
  const double eps = 0.25, f = 0.8, nu = 0.7;
  for (const double level : {0.02, 0.08, 0.15}) {
    point::Problem scene = rubbing(loose_scene(eps, 0, f, nu, 3, 0.5), 0.01, level);
    scene.oscillator.stiffness = 0, scene.loose.place = 0.3;
    const LooseRun run = run_loose(scene, 2);
    ASSERT_GE(run.record.holds.size(), 1u);
    const motion::Event& hold = run.record.holds[0];
    EXPECT_EQ(hold.side, Side::none);
    EXPECT_EQ(hold.time, 0);
    EXPECT_NEAR(hold.place, 0.3, 1e-15);
    const double sine = level / eps * (1 + eps) / f;
    EXPECT_NEAR(hold.length, sine < 1 ? std::asin(sine) / nu : 2, 1e-14) << level;
  }
}

/// The way of a mass that is braked by F/eps less its load, on a main mass that its own friction holds.
TEST(LooseFriction, brakes_a_mass_on_a_housing_that_stands) {
  const double eps = 0.2, F = 0.03, w = 0.4;
  for (const double g : {0.0, 0.1, -0.1}) {
    point::Problem scene = rubbing(loose_scene(eps, 0.1, 0.5, 1.3, 9, 0.5), F);
    scene.friction = {5, 5}, scene.loose.load = g, scene.loose.velocity = w;
    scene.time.mode = steady::Mode::transient, scene.time.duration = 50;
    scene.observe.time_to_rest = scene.observe.energy = scene.observe.wall_energy = true;
    point::ThreadScratch scratch;
    const auto result = run_point(scene, scratch);
    const double brakes = F / eps - g;
    EXPECT_NEAR(result.end.loose_place, w * w / (2 * brakes), 1e-14) << g;
    EXPECT_EQ(result.end.loose_velocity, 0) << g;
    EXPECT_EQ(result.end.displacement, 0) << g;
    EXPECT_NEAR(result.time_to_rest, w / brakes, 1e-13) << g;
    EXPECT_NEAR(result.loss_friction, F * result.end.loose_place, 1e-14) << g;
    EXPECT_NEAR(result.energy_residual, 0, 1e-14) << g;
  }
}

/// z' falls by F (1 + eps)/eps, in an impact to R of it, and the common velocity is that of the momentum.
TEST(LooseFriction, of_free_masses_ends_in_their_common_velocity) {
  const double eps = 0.3, F = 0.02, w = 0.6, R = 0.7;
  point::Problem scene = rubbing(free_pair(eps, R), F);
  scene.start.velocity = 0.1, scene.loose.velocity = w;
  const LooseRun run = run_loose(scene, 60);
  const double brakes = F * (1 + eps) / eps, gap = 1, before = std::sqrt(w * w - 2 * brakes * gap / 2);
  ASSERT_GE(run.record.strikes.size(), 1u);
  EXPECT_NEAR(run.record.strikes[0].before, before, 1e-14);
  EXPECT_NEAR(run.record.strikes[0].time, (w - before) / brakes, 1e-13);
  EXPECT_EQ(run.w, 0);
  EXPECT_NEAR(run.end.v, 0.1 + eps / (1 + eps) * w, 1e-14);
  double left = before * R * before * R / (2 * brakes), side = -1, z = 0.5;
  for (; left > gap; left = R * R * (left - gap), side = -side) z = -z;
  EXPECT_NEAR(run.z, z + side * left, 1e-13);
}

/// As strong as need be, it makes both one mass.
TEST(LooseFriction, that_is_strong_makes_both_one_mass) {
  const double eps = 0.25, h = 0.05, f = 0.5, nu = 1.3, duration = 40;
  point::Problem one;
  one.oscillator = {h / (1 + eps), f / (1 + eps), nu, 0, 1 / (1 + eps)};
  one.start = {0.2, -0.3, 0.7}, one.time.mode = steady::Mode::transient, one.time.duration = duration;
  point::ThreadScratch scratch;
  const auto expected = run_point(one, scratch);
  point::Problem scene = rubbing(loose_scene(eps, h, f, nu, 0.1, 0.4), 10);
  scene.start = one.start, scene.loose.place = 0.03;
  const LooseRun run = run_loose(scene, duration);
  EXPECT_NEAR(run.end.x, expected.end.displacement, 1e-13);
  EXPECT_NEAR(run.end.v, expected.end.velocity, 1e-13);
  EXPECT_NEAR(run.z, 0.03, 1e-17);
  EXPECT_TRUE(run.record.strikes.empty());
}

TEST(LooseFriction, that_vanishes_changes_nothing) {
  point::Problem scene = loose_scene(0.2, 0.1, 0.5, 1.2, 0.4, 0.6);
  scene.loose.velocity = 0.3, scene.loose.load = 0.05;
  const LooseRun without = run_loose(scene, 12);
  // the ends of the motion change in proportion to a small force; how many impacts a chatter has before that ends it is
  // no matter
  const auto change = [&](double F) {
    const LooseRun run = run_loose(rubbing(scene, F), 12);
    return std::max(std::abs(run.end.x - without.end.x), std::abs(run.z - without.z)) / F;
  };
  const double rate = change(1e-6);
  EXPECT_GT(rate, 0.1);
  for (const double F : {1e-4, 1e-8, 1e-10}) EXPECT_NEAR(change(F), rate, 1e-2 * rate) << F;
}

TEST(LooseFriction, mirrored_scenes_move_as_mirror_images) {
  for (const double place : {0.0, 0.2}) {
    point::Problem scene = rubbing(loose_scene(0.1, 0.03, 0.5, 1.2, 0.6, 0.7), 0.12, 0.15), mirror = scene;
    scene.start = {0.1, -0.2, 0.4}, scene.loose.place = place, scene.oscillator.load = 0.05, scene.loose.load = 0.02;
    mirror.oscillator.forcing = -0.5, mirror.oscillator.load = -0.05, mirror.loose.load = -0.02;
    mirror.start = {-0.1, 0.2, 0.4}, mirror.loose.place = -place;
    const LooseRun run = run_loose(scene, 60), other = run_loose(mirror, 60);
    ASSERT_GT(run.record.holds.size(), 10u);
    EXPECT_EQ(run.end.x, -other.end.x);
    EXPECT_EQ(run.end.v, -other.end.v);
    EXPECT_EQ(run.z, -other.z);
    EXPECT_EQ(run.w, -other.w);
  }
}

/// A motion that sections divide is one motion.
TEST(LooseFriction, is_the_same_wherever_a_section_is) {
  point::Problem scene = rubbing(loose_scene(0.2, 0.1, 0.5, 1.2, 0.4, 0.6), 0.02, 0.03);
  const double period = 2 * pi_ / 1.2;
  const LooseRun run = run_loose(scene, 3.3 * period);
  scene.start.phase = -0.4 * 2 * pi_;
  point::Problem later = scene;
  const LooseRun first = run_loose(scene, 0.4 * period);
  later.start = {first.end.x, first.end.v, 0}, later.loose.place = first.z, later.loose.velocity = first.w;
  const LooseRun second = run_loose(later, 2.9 * period), whole = run_loose(scene, 3.3 * period);
  EXPECT_NEAR(second.end.x, whole.end.x, 1e-12);
  EXPECT_NEAR(second.z, whole.z, 1e-12);
  EXPECT_EQ(run.outcome, Outcome::completed);
}

/// Stick and slide in every period, and impacts on one wall or both.
[[nodiscard]] std::vector<point::Problem> every_kind() {
  std::vector<point::Problem> scenes;
  for (const auto& [name, scene] : support::every_loose_kind())
    for (const double part : {0.05, 0.4})
      scenes.push_back(rubbing(scene, part * scene.loose.ratio * 0.3, 1.3 * part * scene.loose.ratio * 0.3));
  return scenes;
}

TEST(LooseFriction, in_double_is_that_of_fifty_digits) {
  for (const point::Problem& scene : every_kind()) {
    const accuracy::RunRecord reference = accuracy::reference_of(scene, 25), run = accuracy::record_of(scene, 25);
    ASSERT_EQ(reference.outcome, Outcome::completed);
    const support::Deviation d = support::deviation(run, reference);
    EXPECT_TRUE(d.same_events) << scene.loose.ratio << ": " << d.difference;
    EXPECT_LT(d.largest(), 1e-13 + 200 * support::conditioning(scene, reference)) << scene.loose.ratio;
  }
}

TEST(LooseFriction, by_dopri5_is_that_of_fifty_digits_to_the_tolerance) {
  for (point::Problem scene : every_kind()) {
    const accuracy::RunRecord reference = accuracy::reference_of(scene, 25);
    const double sensitive = std::max(1.0, support::conditioning(scene, reference) / epsilon<double>());
    for (const double tolerance : {1e-8, 1e-11}) {
      if (tolerance * sensitive > 1e-4) continue;
      scene.integration.method = Method::dopri5, scene.integration.tolerance = tolerance;
      const support::Deviation d = support::deviation(support::record_by<DormandPrince>(scene, 25), reference);
      EXPECT_TRUE(d.same_events) << scene.loose.ratio << ": " << d.difference;
      EXPECT_LT(d.largest(), 30 * tolerance * sensitive) << scene.loose.ratio << ", " << tolerance;
    }
  }
}

/// Under a force that repeats, both as one come to the steady motion of one mass; and a weaker friction lets it slide,
/// to a motion whose losses are all the work.
TEST(LooseFriction, settles) {
  point::Problem scene = rubbing(loose_scene(0.2, 0.05, 0.3, 1.2, 0.4, 0.6), 1);
  const auto held = observed(scene);
  ASSERT_EQ(held.status, steady::Status::periodic);
  EXPECT_EQ(held.period_ratio, 1);
  EXPECT_EQ(held.impact_word, "-");
  const double amplitude = 0.3 / std::hypot(1 - 1.2 * 1.44, 2 * 0.05 * 1.2);
  EXPECT_NEAR(held.x_max, amplitude, 1e-9);
  EXPECT_EQ(held.loss_friction, 0);
  for (const double F : {0.005, 0.02, 0.05}) {
    const auto result = observed(rubbing(scene, F));
    ASSERT_EQ(result.status, steady::Status::periodic) << F;
    EXPECT_GT(result.loss_friction, 0) << F;
    EXPECT_NEAR(result.energy_residual, 0, 1e-10) << F;
  }
}

}  // namespace
}  // namespace clatter::stepping::loose_friction_test
