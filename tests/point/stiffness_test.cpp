// Motion without a spring, or with an unstable one, against its closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "point/point.hpp"
#include "scene/response.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::point::stiffness_test {
namespace {

using std::numbers::pi;

PointResult run(const Problem& scene) {
  ThreadScratch scratch;
  return run_point(scene, scratch);
}

/// A ball that bounces on a table at x = 0: gravity 1, the table's acceleration Gamma sin(tau) as a force.
Problem bouncing_ball(double Gamma, double R, double phase, double v0) {
  Problem scene = support::scene_of({0.0, Gamma, 1.0, -1.0, 0.0}, 0.0, std::numeric_limits<double>::infinity(), R);
  scene.start = {0.0, v0, phase};
  scene.observe = {};
  scene.observe.impacts = scene.observe.period = scene.observe.stability = true;
  return scene;
}

/// The impact phase at which the ball bounces once in n periods: Gamma cos(phase) = n pi (1 - R)/(1 + R).
double lowest_gamma(int n, double R) { return n * pi * (1 - R) / (1 + R); }
double flip_gamma(int n, double R) { return std::hypot(lowest_gamma(n, R), 2 * (1 + R * R) / ((1 + R) * (1 + R))); }

TEST(BouncingBall, bounces_once_in_n_periods_with_the_known_speed_and_multipliers) {
  for (const double R : {0.3, 0.8, 0.95})
    for (const int n : {1, 2})
      for (const double part : {0.05, 0.4, 0.9, 0.999}) {
        const double low = lowest_gamma(n, R), Gamma = low + part * (flip_gamma(n, R) - low);
        const double sine = std::sqrt((Gamma - low) * (Gamma + low)) / Gamma, phase = std::asin(sine);
        const double after = 2 * pi * n * R / (1 + R);
        // from half a period after the impact, so that no section is at one; a little off the motion, which attracts
        Problem scene = bouncing_ball(Gamma, R, phase + pi, after - pi + 2 * lowest_gamma(n, R));
        scene.start.displacement = after * pi - pi * pi / 2 + Gamma * (2 * sine) + lowest_gamma(n, R) * pi + 1e-8;
        const PointResult found = run(scene);
        ASSERT_EQ(found.status, steady::Status::periodic) << R << " " << Gamma;
        EXPECT_EQ(found.period_ratio, n);
        const double trace = 1 + R * R - (1 + R) * (1 + R) * Gamma * sine, slow = 1 + R * R - std::abs(trace);
        const double tolerance = 1e-11 / std::min(1.0, slow);  // of a repeat: 1e-12, seen through the slower multiplier
        EXPECT_NEAR(found.v_before[0], -2 * pi * n / (1 + R), tolerance);
        EXPECT_NEAR(found.v_after[0], after, tolerance);
        EXPECT_NEAR(found.multiplier_re[0] + found.multiplier_re[1], trace, 10 * tolerance);
        EXPECT_NEAR(found.multiplier_re[0] * found.multiplier_re[1] - found.multiplier_im[0] * found.multiplier_im[1],
                    R * R, 10 * tolerance);
      }
}

TEST(BouncingBall, doubles_its_period_at_the_known_acceleration) {
  const double R = 0.8, flip = flip_gamma(1, R), phase = std::acos(lowest_gamma(1, R) / flip);
  Problem below = bouncing_ball(flip * (1 - 1e-3), R, phase, 2 * pi * R / (1 + R)),
          above = bouncing_ball(flip * (1 + 1e-3), R, phase, 2 * pi * R / (1 + R));
  EXPECT_EQ(run(below).period_ratio, 1);
  EXPECT_EQ(run(above).period_ratio, 2);
}

TEST(BouncingBall, without_a_force_comes_to_rest_after_the_known_time) {
  // flights 2 v R^k: dropped with speed v, all are over after 2 v R/(1 - R)
  Problem scene = bouncing_ball(0.0, 0.5, 0.0, 0.0);
  scene.start = {0.0, 3.0, 0.0};
  const auto whole = support::run_scene(scene, 13.0);
  EXPECT_EQ(whole.outcome, stepping::Outcome::completed);
  const auto held = std::ranges::find_if(whole.record.rests, &motion::Event::held);
  ASSERT_NE(held, whole.record.rests.end());
  EXPECT_NEAR(held->time, 2 * 3.0 / (1 - 0.5), 1e-14 * 12);
  EXPECT_EQ(run(scene).found_by, steady::FoundBy::standstill);
}

/// Free motion over a time by exponentials, for k <= 0: [x by x, x by v, v by x, v by v].
std::array<double, 4> free_flow(double h, double k, double time) {
  const double root = std::sqrt(h * h - k), fast = -h - root, slow = -h + root;
  if (root == 0) return {1, time, 0, 1};
  const double e = std::exp(fast * time), g = std::exp(slow * time), width = slow - fast;
  return {(slow * e - fast * g) / width, (g - e) / width, slow * fast * (e - g) / width, (slow * g - fast * e) / width};
}

/// The larger speed of symmetric motion with one impact on each stop in a period (eq. 37); NaN if there is none.
double speed_of_symmetric_motion(const Oscillator& o, double gap, double R) {
  const auto [xx, xv, vx, vv] = free_flow(o.damping, o.stiffness, pi / o.frequency);
  const double D = 1 + xx + vv + xx * vv - xv * vx;
  const double alpha = (1 + R) * xv / D, gamma = ((1 + R) * (1 + xx) / D - R) / o.frequency;
  const double A = steady_response(o).amplitude, a = alpha * alpha + gamma * gamma, b = alpha * gap;
  return (b + std::sqrt(b * b - a * (gap * gap - A * A))) / a;
}

TEST(SymmetricMotion, between_walls_without_a_spring_or_with_an_unstable_one_has_its_closed_form) {
  int found = 0, periodic = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    support::Random random(7, i);
    const double k = i % 2 == 0 ? 0.0 : -random.logarithmic(0.05, 2), R = random.uniform(0.2, 0.9),
                 gap = random.logarithmic(0.05, 1);
    Problem scene = support::scene_of(
        {random.happens(0.2) ? 0.0 : random.logarithmic(1e-2, 1), 1.0, random.logarithmic(0.7, 3), 0.0, k}, -gap, gap,
        R);
    scene.observe = {};
    scene.observe.impacts = scene.observe.period = scene.observe.word = true;
    scene.time.max_periods = 2000;
    const PointResult result = run(scene);
    if (result.status != steady::Status::periodic) continue;
    ++periodic;
    if (result.period_ratio != 1 || result.impact_word.size() != 2 || !(result.symmetric > 0)) continue;
    const double speed = speed_of_symmetric_motion(scene.oscillator, gap, R);
    EXPECT_NEAR(std::abs(result.v_before[0]), speed, 1e-9 * std::max(1.0, speed)) << i;
    EXPECT_NEAR(std::abs(result.v_before[1]), speed, 1e-9 * std::max(1.0, speed)) << i;
    ++found;
  }
  EXPECT_GT(found, 60);
  std::cout << found << " of " << periodic << " periodic motions have the closed form\n";
}

TEST(Stiffness, of_any_spring_is_that_of_1_in_other_units_of_time) {
  for (std::size_t i = 0; i < 100; ++i) {
    support::Random random(8, i);
    const double k = random.logarithmic(1e-2, 1e2), rate = std::sqrt(k);
    const Oscillator unit{random.logarithmic(1e-2, 1.5), 1.0, random.logarithmic(0.3, 3), random.uniform(-0.2, 0.2)};
    Problem one = support::scene_of(unit, -0.4, 0.5, random.uniform(0.1, 0.8));
    one.start.velocity = 0.3;
    Problem other = one;
    other.oscillator = {unit.damping * rate, unit.forcing * k, unit.frequency * rate, unit.load * k, k};
    other.start.velocity *= rate;
    const auto a = support::run_scene(one, 6.0), b = support::run_scene(other, 6.0 / rate);
    ASSERT_EQ(a.record.impacts.size(), b.record.impacts.size()) << i;
    for (std::size_t j = 0; j < a.record.impacts.size(); ++j) {
      // the rounding of the units, and what impacts make of it
      EXPECT_NEAR(a.record.impacts[j].time, b.record.impacts[j].time * rate, 1e-9) << i;
      EXPECT_NEAR(a.record.impacts[j].before, b.record.impacts[j].before / rate, 1e-9) << i;
    }
  }
}

TEST(Escape, is_reported_if_nothing_brings_the_mass_back) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto status = [](const Oscillator& o, double lower, double upper, double x, double v) {
    Problem scene = support::scene_of(o, lower, upper, 0.5);
    scene.start = {x, v, 0.0};
    return run(scene).status;
  };
  EXPECT_EQ(status({0.1, 0.2, 1.0, 0.0, -1.0}, -1, none, 3.0, 0.0), steady::Status::escaped);  // down the far side
  EXPECT_EQ(status({0.1, 0.2, 1.0, 0.0, -1.0}, -none, 1, -3.0, 0.0), steady::Status::escaped);
  EXPECT_EQ(status({0.0, 0.2, 1.0, 0.5, 0.0}, 0, none, 1.0, 0.0), steady::Status::escaped);  // pulled off its stop
  EXPECT_EQ(status({0.1, 0.0, 1.0, 0.5, 0.0}, 0, none, 1.0, 0.0), steady::Status::escaped);
  EXPECT_EQ(status({0.0, 0.0, 1.0, 0.0, 0.0}, 0, none, 1.0, -1.0), steady::Status::escaped);  // after one rebound
  // a damped mass without spring and load comes to a halt, a loaded one to its stop
  EXPECT_EQ(status({0.1, 0.0, 1.0, 0.0, 0.0}, 0, none, 1.0, 0.5), steady::Status::periodic);
  EXPECT_EQ(status({0.0, 0.0, 1.0, -0.5, 0.0}, 0, none, 1.0, 0.5), steady::Status::periodic);
  // a mass that is balanced exactly stays there, one beside the balance is caught between two stops
  EXPECT_EQ(status({0.1, 0.0, 1.0, 0.0, -1.0}, -1, none, 0.0, 0.0), steady::Status::periodic);
  EXPECT_EQ(status({0.1, 0.0, 1.0, 0.0, -1.0}, -1, 1, 1e-9, 0.0), steady::Status::periodic);
  // an undamped resonance grows for ever, unless a stop or a damper takes energy
  EXPECT_EQ(status({0.0, 0.1, 1.0, 0.3, 1.0}, -none, none, 0.0, 0.0), steady::Status::escaped);
  EXPECT_EQ(status({0.0, 0.1, std::sqrt(2.0), 0.0, 2.0}, -none, none, 1.0, 0.0), steady::Status::escaped);
  EXPECT_EQ(status({0.0, 0.1, std::sqrt(2.0), 0.0, 2.0}, -1, 1, 0.0, 0.0), steady::Status::periodic);
  EXPECT_EQ(status({0.1, 0.1, 1.0, 0.0, 1.0}, -none, none, 0.0, 0.0), steady::Status::periodic);
}

TEST(Overflow, of_an_energy_fails_a_point_as_one_of_the_motion_does) {
  // down the far side of an unstable spring: the velocity reaches 2e246, its square is beyond the range of double
  Problem scene = support::scene_of({0, 12, 12, 0, -8}, -std::numeric_limits<double>::infinity(), -1.8, 0.5);
  scene.start = {-3.8, 0, 0};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 200;
  scene.observe.extrema = true;
  EXPECT_EQ(run(scene).status, steady::Status::transient);
  scene.observe.energy = true;
  EXPECT_EQ(run(scene).status, steady::Status::not_finite);
  scene.time.duration = 20;
  EXPECT_EQ(run(scene).status, steady::Status::transient);
}

}  // namespace
}  // namespace clatter::point::stiffness_test
