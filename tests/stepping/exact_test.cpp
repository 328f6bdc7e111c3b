#include "stepping/exact.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <utility>

#include "point/exact_motion.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::exact_test {
namespace {

constexpr double pi_ = std::numbers::pi;

const Oscillator pressing_half{0.1, 1.0, 0.5, 0.0};  // chatter and rest with x_s = 0.5, R = 0.5, from rest

TEST(Exact, chatter_is_completed_and_the_mass_rests_until_its_release) {
  const auto run = support::run_scene(support::scene_of(pressing_half, -0.5, 0.5, 0.5), 9.0);
  const auto& impacts = run.record.impacts;
  EXPECT_NEAR(impacts.at(0).time, 2.0515931595927638, 1e-14);
  EXPECT_NEAR(impacts.at(0).before, 0.57647176137699961, 1e-14);
  EXPECT_NEAR(impacts.at(1).time, 3.1907700695690808, 1e-14);
  ASSERT_EQ(run.record.rests.size(), 2u);  // the end of the chatter, and the rest
  EXPECT_FALSE(run.record.rests[0].held);
  const motion::Event& rest = run.record.rests[1];
  EXPECT_TRUE(rest.held);
  EXPECT_NEAR(rest.time, 4.4158803670592697, 1e-14);
  EXPECT_NEAR(rest.time + rest.length, 5 * pi_ / 3, 1e-14);
  const motion::Event& lower = impacts.back();
  EXPECT_EQ(lower.side, Side::lower);
  EXPECT_NEAR(lower.time, 7.9756605890323812, 2e-14);
  EXPECT_NEAR(lower.before, -0.7854147777624616, 2e-14);
}

TEST(Exact, inelastic_mass_rests_at_each_contact) {
  const auto run = support::run_scene(support::scene_of(pressing_half, -0.5, 0.5, 0.0), 4 * pi_);
  ASSERT_EQ(run.record.rests.size(), 2u);
  EXPECT_EQ(run.record.impacts.size(), 2u);
  EXPECT_NEAR(run.record.rests[0].time + run.record.rests[0].length, 5 * pi_ / 3, 1e-14);
  EXPECT_NEAR(run.record.rests[1].time + run.record.rests[1].length, 11 * pi_ / 3, 2e-14);
}

TEST(Exact, a_graze_missed_by_1e_12_gives_no_impact_in_ten_thousand_periods) {
  const double amplitude = 0.777909841584413976;
  point::Problem scene =
      support::scene_of({0.1, 1.0, 1.5, 0.0}, -amplitude * (1 + 1e-12), amplitude * (1 + 1e-12), 0.7);
  scene.start = {-0.181543116490166415, -1.13464447806354009, 0.0};
  const auto run = support::run_scene(scene, 1e4 * 2 * pi_ / 1.5);
  EXPECT_EQ(run.outcome, Outcome::completed);
  EXPECT_TRUE(run.record.impacts.empty());
}

TEST(Exact, spends_at_most_ten_evaluations_an_impact_on_figures_14_to_19) {
  const struct { double R, xs; } figures[] = {{0.9, 0.5}, {0.3, 0.5}, {0.7, 0.3}, {0.7, 0.4}, {0.7, 0.5}, {0.7, 0.6}};
  for (const auto& [R, xs] : figures) {
    const auto run = support::run_scene(support::scene_of({0.1, -1.0, 1.0, 0.0}, -xs, xs, R), 200 * 2 * pi_);
    ASSERT_GT(run.record.impacts.size(), 300u);
    EXPECT_LE(run.evaluations, 10.0 * static_cast<double>(run.record.impacts.size())) << "R = " << R << ", xs = " << xs;
  }
}

void expect_same_bits(const support::Recorder& a, const support::Recorder& b, double sign, double scale) {
  ASSERT_EQ(a.impacts.size(), b.impacts.size());
  for (std::size_t i = 0; i < a.impacts.size(); ++i) {
    EXPECT_EQ(a.impacts[i].time, b.impacts[i].time);
    EXPECT_EQ(sign * sign_of(a.impacts[i].side), sign_of(b.impacts[i].side));
    EXPECT_EQ(sign * scale * a.impacts[i].before, b.impacts[i].before);
    EXPECT_EQ(sign * scale * a.impacts[i].after, b.impacts[i].after);
  }
  ASSERT_EQ(a.rests.size(), b.rests.size());
  for (std::size_t i = 0; i < a.rests.size(); ++i) EXPECT_EQ(a.rests[i].length, b.rests[i].length);
}

std::vector<point::Problem> scenes_for_symmetry() {
  std::vector<point::Problem> scenes;
  for (double h : {0.0, 0.1, 1.0, 1.7})
    for (double nu : {0.5, 1.0, 1.31}) {
      point::Problem scene = support::scene_of({h, 1.1, nu, 0.15}, -0.4, 0.3, 0.6);
      scene.stops.restitution_upper = 0.8;
      scene.start = {0.1, -0.7, 0.3};
      scenes.push_back(scene);
    }
  return scenes;
}

TEST(Exact, mirrored_scenes_move_alike_to_the_last_bit) {
  for (const point::Problem& scene : scenes_for_symmetry()) {
    point::Problem mirror = scene;
    mirror.oscillator.forcing *= -1, mirror.oscillator.load *= -1;
    mirror.stops = {-scene.stops.upper, -scene.stops.lower, scene.stops.restitution_upper,
                    scene.stops.restitution_lower};
    mirror.start.displacement *= -1, mirror.start.velocity *= -1;
    const auto a = support::run_scene(scene, 100.0), b = support::run_scene(mirror, 100.0);
    ASSERT_FALSE(a.record.impacts.empty());
    expect_same_bits(a.record, b.record, -1, 1);
    EXPECT_EQ(a.end.x, -b.end.x);
  }
}

TEST(Exact, scenes_scaled_by_a_power_of_two_move_alike_to_the_last_bit) {
  for (const point::Problem& scene : scenes_for_symmetry())
    for (double scale : {0x1p-30, 0x1p40}) {
      point::Problem scaled = scene;
      scaled.oscillator.forcing *= scale, scaled.oscillator.load *= scale;
      scaled.stops.lower *= scale, scaled.stops.upper *= scale;
      scaled.start.displacement *= scale, scaled.start.velocity *= scale;
      const auto a = support::run_scene(scene, 100.0), b = support::run_scene(scaled, 100.0);
      expect_same_bits(a.record, b.record, 1, scale);
      EXPECT_EQ(a.end.x * scale, b.end.x);
    }
}

/// The events of twenty periods that begin so many periods after the first one, and the displacement at their end.
std::pair<support::Recorder, double> twenty_periods(const point::Problem& scene, std::int64_t later) {
  const auto motion = point::ExactMotion::of(scene);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  motion::State<double> state = motion->start();
  state.periods = later;
  EXPECT_EQ(motion->run_for(state, 20.0, recorder), Outcome::completed);
  support::Recorder record;
  for (const motion::Event& event : recorder.events) record.event(event);
  return {record, state.x};
}

TEST(Exact, a_start_whole_periods_later_moves_alike_to_the_last_bit) {
  for (const point::Problem& scene : scenes_for_symmetry()) {
    const auto [now, x] = twenty_periods(scene, 0);
    const auto [later, x_later] = twenty_periods(scene, 1'000'000'007);
    expect_same_bits(now, later, 1, 1);
    EXPECT_EQ(x, x_later);
  }
}

TEST(Exact, keeps_the_forcing_phase_over_a_hundred_thousand_periods) {
  // linear steady state: after any number of periods the state at a section is the one at the start
  const double amplitude = 0.777909841584413976;
  point::Problem scene = support::scene_of({0.1, 1.0, 1.5, 0.0}, -2 * amplitude, 2 * amplitude, 0.7);
  scene.start = {-0.181543116490166415, -1.13464447806354009, 0.0};
  const auto motion = point::ExactMotion::of(scene);
  point::MotionRecorder recorder(motion->stops());
  motion::State<double> state = motion->start();
  ASSERT_EQ(motion->run_for(state, 1e5, recorder), Outcome::completed);
  EXPECT_NEAR(state.x, scene.start.displacement, 1e-15);
  EXPECT_NEAR(state.v, scene.start.velocity, 1e-15);
}

TEST(Exact, starts_on_a_stop_are_handled_each_way) {
  point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5);
  scene.start = {0.5, 0.25, 0.0};  // moving in: an impact at once, taken once
  const auto in = support::run_scene(scene, 0.1);
  ASSERT_EQ(in.record.impacts.size(), 1u);
  EXPECT_EQ(in.record.impacts[0].time, 0.0);
  EXPECT_EQ(in.record.impacts[0].after, -0.125);
  scene.start = {0.5, -0.25, 0.0};  // moving out: none
  EXPECT_TRUE(support::run_scene(scene, 0.1).record.impacts.empty());
  scene.start = {0.5, 0.0, pi_ / 2};  // at rest, pressed with 1 - 0.5: released where sin = 1/2, at phase 5 pi/6
  const auto pressed = support::run_scene(scene, 3.0);
  ASSERT_EQ(pressed.record.rests.size(), 1u);
  EXPECT_NEAR(pressed.record.rests[0].length, (5 * pi_ / 6 - pi_ / 2) / 0.5, 1e-14);
  EXPECT_LT(pressed.end.x, 0.5);
  scene.start = {0.5, 0.0, 0.0};  // at rest, pulled off by the spring
  const auto pulled = support::run_scene(scene, 0.1);
  EXPECT_TRUE(pulled.record.rests.empty());
  EXPECT_LT(pulled.end.x, 0.5);
}

TEST(Exact, an_impact_at_the_end_of_a_run_is_taken_once) {
  // free vibration |x'| = 1.5 between stops at 0.75: contacts at arcsin(0.5) and then every 2 arcsin(0.5)
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -0.75, 0.75, 1.0);
  scene.start = {0.0, 1.5, 0.0};
  const double contact = std::asin(0.5);
  EXPECT_EQ(support::run_scene(scene, 3 * contact).record.impacts.size(), 2u);
  EXPECT_EQ(support::run_scene(scene, 3 * contact * (1 - 1e-12)).record.impacts.size(), 1u);
}

TEST(Exact, a_stop_that_never_presses_does_not_hold_at_the_tangency) {
  // |f| = x_stop - load: the pull just vanishes at the peak, where its rounding may have either sign
  for (double before : {1e-9, 1e-8, 1e-3}) {
    point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -1.0, 1.0, 0.7);
    scene.start = {1.0, 0.0, pi_ / 2 - before};
    const auto run = support::run_scene(scene, 30.0);
    EXPECT_TRUE(run.record.rests.empty() || !run.record.rests[0].held) << before;
    EXPECT_LT(run.end.x, 1.0);
  }
}

TEST(Exact, a_stop_that_always_presses_holds_through_the_tangency) {
  // load - x_stop = |f|: the pressing force just vanishes at the trough
  for (double R : {0.0, 0.7, 0.99}) {
    point::Problem scene = support::scene_of({0.0, 1.0, 1.0, 1.5}, -0.5, 0.5, R);
    scene.start = {0.5, 0.0, -pi_ / 2};
    const auto run = support::run_scene(scene, 50.0);
    EXPECT_TRUE(run.record.impacts.empty()) << R;
    EXPECT_EQ(run.end.x, 0.5);
  }
}

TEST(Exact, flights_too_short_to_move_time_on_are_rest) {
  // elastic, and released within rounding of the phase at which the force presses again: bounces of 1e-31 would never
  // end
  point::Problem scene = support::scene_of({0.0, 1.0, 1.0, -0.25}, -0.25, 0.25, 1.0);
  scene.stops.restitution_lower = 0.3;
  scene.start = {0.25, 0.0, pi_ / 6};
  scene.time.max_impacts = 1e4;
  EXPECT_EQ(support::run_scene(scene, 20.0).outcome, Outcome::completed);
}

TEST(Exact, heavier_damping_does_not_cost_more) {
  for (double h : {1e2, 1e6, 1e12}) {
    const auto run = support::run_scene(support::scene_of({h, h, 0.5, 0.0}, -0.5, 0.5, 0.5), 30.0);
    EXPECT_EQ(run.outcome, Outcome::completed);
    EXPECT_LT(run.evaluations, 5000.0) << h;
  }
}

TEST(Exact, a_slow_force_does_not_cost_more) {
  for (double nu : {1e-3, 1e-6, 1e-9}) {
    const auto run = support::run_scene(support::scene_of({0.1, 1.0, nu, 0.0}, -0.5, 0.5, 0.5), 4 * 2 * pi_ / nu);
    EXPECT_EQ(run.outcome, Outcome::completed);
    EXPECT_NEAR(static_cast<double>(run.record.impacts.size()), 160, 20) << nu;  // chatter onto a stop twice a period
    EXPECT_LT(run.evaluations, 2000.0) << nu;
  }
}

TEST(Exact, no_impact_leaves_a_stop) {
  // rounding of a release under very heavy damping once put the mass back on the stop it was leaving
  const auto run = support::run_scene(support::scene_of({1e6, 30.0, 0.5, 0.0}, -2.0, 2.0, 0.0), 40.0);
  EXPECT_EQ(run.outcome, Outcome::completed);
  for (const motion::Event& impact : run.record.impacts) EXPECT_GE(impact.before * sign_of(impact.side), 0.0);
}

TEST(Exact, motion_may_fade_far_below_its_stops) {
  point::Problem scene =
      support::scene_of({0.1, 0.0, 1.0, 0.0}, 0.0, 2.0, 0.9);  // decays onto a stop at its equilibrium
  scene.start.displacement = 1.0;
  EXPECT_EQ(support::run_scene(scene, 1e4).outcome, Outcome::completed);
  EXPECT_EQ(support::run_scene(support::scene_of({0.0, 1e-300, 1.0, 0.0}, -1.0, 1.0, 0.9), 100.0).outcome,
            Outcome::completed);
}

TEST(Exact, more_impacts_than_allowed_is_an_outcome) {
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -0.75, 0.75, 1.0);
  scene.start = {0.0, 1.5, 0.0};
  scene.time.max_impacts = 10;
  EXPECT_EQ(support::run_scene(scene, 100.0).outcome, Outcome::event_budget);
}

TEST(Exact, release_at_the_edge_of_a_section_neither_hangs_nor_rests_a_turn_too_long) {
  // the upper stop releases at phase 5 pi/6 (eq. 26); sections are at the start's phase: one just before, on and just
  // after the release
  for (double offset : {-1e-15, 0.0, 1e-15}) {
    point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.0);
    scene.start = {0.5, 0.0, 5 * pi_ / 6 + offset};
    const auto run = support::run_scene(scene, 4 * pi_);
    EXPECT_EQ(run.outcome, Outcome::completed);
    EXPECT_GE(run.record.impacts.size(), 2u);
  }
}

}  // namespace
}  // namespace clatter::stepping::exact_test
