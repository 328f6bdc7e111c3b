// A loose mass by Dormand and Prince's method, which shares the phases of the exact one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stepping/dormand_prince.hpp"
#include "support/deviation.hpp"
#include "support/loose_scenes.hpp"
#include "support/methods.hpp"

namespace clatter::stepping::dormand_prince_loose_mass_test {
namespace {

using accuracy::Event;
using accuracy::RunRecord;
using support::loose_scene;

RunRecord run_of(point::Problem scene, double tolerance, double duration) {
  scene.integration.method = Method::dopri5, scene.integration.tolerance = tolerance;
  return support::record_by<DormandPrince>(scene, duration);
}

/// Every step errs by about the tolerance, which the motion multiplies as much as an ulp of its inputs.
void expect_the_motion_of_fifty_digits(const point::Problem& scene, double duration, const std::string& name) {
  const RunRecord reference = accuracy::reference_of(scene, duration);
  ASSERT_EQ(reference.outcome, Outcome::completed) << name;
  const double sensitive = std::max(1.0, support::conditioning(scene, reference) / epsilon<double>());
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    if (tolerance * sensitive > 1e-4) continue;
    const support::Deviation d = support::deviation(run_of(scene, tolerance, duration), reference);
    EXPECT_TRUE(d.same_events) << name << ", " << tolerance << ": " << d.difference;
    EXPECT_LT(d.largest(), 10 * tolerance * sensitive) << name << ", " << tolerance;
  }
}

TEST(DormandPrinceLooseMass, of_every_kind_is_that_of_fifty_digits) {
  for (const auto& [name, scene] : support::every_loose_kind()) expect_the_motion_of_fifty_digits(scene, 25, name);
}

TEST(DormandPrinceLooseMass, of_random_scenes_is_that_of_fifty_digits) {
  for (std::uint64_t index = 0; index < 30; ++index)
    expect_the_motion_of_fifty_digits(support::random_loose_scene(index), 12, "scene " + std::to_string(index));
}

TEST(DormandPrinceLooseMass, an_impact_damper_settles_on_the_closed_form_to_the_tolerance) {
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    const RunRecord record = run_of(support::impact_damper(), tolerance, 3000 * 2 * pi<double>());
    ASSERT_EQ(record.outcome, Outcome::completed);
    ASSERT_GT(record.events.size(), 5000u);
    // over the 1/h = 200 of tau in which errors fade there are some thousand steps
    EXPECT_NEAR(record.events.back().speed(), support::impact_damper_speed, 2000 * tolerance * 0.01) << tolerance;
  }
}

TEST(DormandPrinceLooseMass, error_falls_with_the_tolerance) {
  const point::Problem scene = loose_scene(0.3, 0.05, 0.4, 1.7, 0.3, 0.7);
  const RunRecord exact = accuracy::record_of(scene, 40);
  std::vector<double> tolerances, errors;
  for (double tolerance = 1e-5; tolerance > 1e-12; tolerance /= 10) {
    const support::Deviation d = support::deviation(run_of(scene, tolerance, 40), exact);
    ASSERT_TRUE(d.same_events) << d.difference;
    tolerances.push_back(tolerance), errors.push_back(d.largest());
  }
  EXPECT_NEAR(support::order_of(tolerances, errors), 1, 0.15);
}

/// Without a force z'' = g until the wall: its chatter is a geometric series.
TEST(DormandPrinceLooseMass, bounces_like_a_ball_on_a_housing_that_stands_until_it_is_pressed) {
  const double g = 0.8, R = 0.6, height = 0.5, first = std::sqrt(2 * height / g);
  point::Problem scene = loose_scene(1e-16, 0, 0, 1, 1, R);
  scene.loose.load = -g, scene.loose.lower = -height;
  const RunRecord record = run_of(scene, 1e-10, 20);
  double time = first, speed = std::sqrt(2 * g * height);
  ASSERT_GT(record.events.size(), 25u);
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_NEAR(record.events[i].time, time, 1e-13);
    EXPECT_NEAR(record.events[i].before / -speed, 1, 1e-10);
    speed *= R, time += 2 * speed / g;
  }
  const auto rest = std::ranges::find(record.events, Event::Kind::rest, &Event::kind);
  ASSERT_NE(rest, record.events.end());
  EXPECT_NEAR(rest->time, first * (1 + R) / (1 - R), 1e-13);
  EXPECT_EQ(record.z, -height);
  EXPECT_EQ(record.w, 0);
}

/// The wall lets go where both masses as one have x'' = g.
TEST(DormandPrinceLooseMass, a_wall_lets_go_where_it_would_have_to_pull) {
  const point::Problem scene = support::pressed_scene();
  const auto exact = support::rests_of(accuracy::record_of(scene, 60)),
             found = support::rests_of(run_of(scene, 1e-11, 60));
  ASSERT_GT(exact.size(), 3u);
  ASSERT_EQ(found.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_EQ(found[i].side, exact[i].side);
    EXPECT_NEAR(found[i].time, exact[i].time, 1e-8);
    EXPECT_NEAR(found[i].end(), exact[i].end(), 1e-8);
  }
}

TEST(DormandPrinceLooseMass, between_sections_depends_on_the_state_alone) {
  for (const auto& [name, scene] : support::every_loose_kind()) {
    const auto first = support::general_method<DormandPrince>(scene);
    motion::State<double> state = support::start_of(scene);
    for (int period = 0; period < 6; ++period) {
      motion::State<double> copy = state;
      ASSERT_EQ(first->advance_to_section(state, 0), Outcome::completed) << name;
      ASSERT_EQ(support::general_method<DormandPrince>(scene)->advance_to_section(copy, 0), Outcome::completed) << name;
      EXPECT_EQ(state.x, copy.x) << name;
      EXPECT_EQ(state.loose.place, copy.loose.place) << name;
      EXPECT_EQ(state.loose.speed, copy.loose.speed) << name;
    }
  }
}

TEST(DormandPrinceLooseMass, mirrored_scenes_move_as_mirror_images) {
  point::Problem scene = support::random_loose_scene(3), mirror = scene;
  for (double* value : {&mirror.oscillator.forcing, &mirror.oscillator.load, &mirror.start.displacement,
                        &mirror.start.velocity, &mirror.loose.place, &mirror.loose.velocity, &mirror.loose.load})
    *value = -*value;
  const RunRecord run = run_of(scene, 1e-8, 40), other = run_of(mirror, 1e-8, 40);
  EXPECT_EQ(run.x, -other.x);
  EXPECT_EQ(run.z, -other.z);
  EXPECT_EQ(run.w, -other.w);
  EXPECT_EQ(run.impacts, other.impacts);
}

TEST(DormandPrinceLooseMass, a_run_that_it_cannot_complete_is_an_outcome) {
  point::Problem scene = loose_scene(0.4, 0, 0, 1, 0.05, 1);
  scene.loose.velocity = 1, scene.time.max_impacts = 10;
  EXPECT_EQ(run_of(scene, 1e-8, 100).outcome, Outcome::event_budget);
  scene.time.max_impacts = 1e6, scene.start.velocity = 1e308, scene.loose.velocity = 1e308;
  EXPECT_EQ(run_of(scene, 1e-8, 100).outcome, Outcome::not_finite);
}

}  // namespace
}  // namespace clatter::stepping::dormand_prince_loose_mass_test
