// The forcing phase of impacts, and their velocities as seen from the ground.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sweep/shaken_scenes.hpp"

namespace clatter::sweep::impact_phase_test {
namespace {

using observables::LoggedImpact;

constexpr double pi_ = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// An angle as its distance from a whole turn, -pi ... pi.
double around_zero(double angle) { return std::remainder(angle, 2 * pi_); }

std::vector<LoggedImpact> impacts_of(point::Problem scene) {
  scene.observe.impact_log = true;
  return run(scene, Frame::relative).log;
}

/// A ball under gravity g on a table that moves as b sin(nu tau + phase + lead), struck with R.
struct Ball {
  double b = 0.6, nu = 1.0, g = 1.0, R = 0.8, phase = 0.0, lead = 0.0;

  [[nodiscard]] point::Problem scene(Shaking shaking) const {
    shaking.phase = lead;
    point::Problem scene = shaken({.frequency = nu, .load = -g, .stiffness = 0.0}, shaking, {0.0, infinity, R, 1.0});
    scene.start = {0.01, 2.9 * g / nu, phase};
    return scene;
  }
  /// It bounces once a period T = 2 pi/nu if it leaves at gT/2, in the frame of the ground: b nu cos(theta + lead) (1 +
  /// R) = (1 - R) gT/2.
  [[nodiscard]] double cosine() const { return (1 - R) / (1 + R) * g * pi_ / (b * nu * nu); }
  [[nodiscard]] double landing() const { return -g * pi_ / nu; }
};

TEST(ImpactPhase, of_a_ball_that_bounces_once_a_period_has_its_closed_form) {
  for (const Ball ball : {Ball{}, Ball{.phase = 2.0}, Ball{.phase = 0.8 - 12 * pi_, .lead = 0.7},
                          Ball{.b = 0.08, .nu = 3.0, .g = 1.0, .R = 0.7, .phase = 2.5, .lead = -2.0}})
    for (const Shaking shaking : {Shaking{.base = ball.b}, Shaking{.stops = ball.b}}) {
      const point::Problem scene = ball.scene(shaking);
      const auto impacts = impacts_of(scene);
      ASSERT_EQ(impacts.size(), 1u) << ball.phase;
      const LoggedImpact& impact = impacts[0];
      EXPECT_GE(impact.phase, 0.0);
      EXPECT_LT(impact.phase, 2 * pi_);
      // the repeat is exact to the tolerance of 1e-12, of a velocity of pi
      EXPECT_NEAR(std::cos(impact.phase + ball.lead), ball.cosine(), 1e-11);
      EXPECT_NEAR(impact.absolute, ball.landing(), 1e-11);
      EXPECT_NEAR(impact.before, ball.landing() - ball.b * ball.nu * std::cos(impact.phase + ball.lead), 1e-11);
    }
}

TEST(ImpactPhase, of_a_force_is_that_of_the_table_whose_acceleration_it_is) {
  const Ball ball;
  point::Problem scene = shaken({.forcing = ball.b, .load = -ball.g, .stiffness = 0.0}, {}, {0, infinity, ball.R, 1});
  scene.start = {0.01, 2.9, 0.0};
  const auto by_force = impacts_of(scene), by_table = impacts_of(ball.scene({.base = ball.b}));
  ASSERT_EQ(by_force.size(), 1u);
  EXPECT_EQ(by_force[0].phase, by_table[0].phase);
  EXPECT_EQ(by_force[0].before, by_table[0].before);
  EXPECT_EQ(by_force[0].absolute, by_force[0].before);  // nothing is shaken
}

TEST(ImpactPhase, keeps_its_digits_however_late_the_impact_is) {
  const Ball ball;
  point::Problem scene = ball.scene({.base = ball.b});
  scene.time.mode = steady::Mode::transient, scene.time.duration = 1e5 * 2 * pi_;
  const auto impacts = impacts_of(scene);
  ASSERT_GT(impacts.size(), 99'000u);
  const LoggedImpact& last = impacts.back();
  EXPECT_NEAR(std::cos(last.phase), ball.cosine(), 1e-14);  // its time of 6e5 alone would leave 1e-10
  EXPECT_NEAR(last.absolute, ball.landing(), 2e-14);
}

/// Random scenes with a force, shaken stops, or a shaken base, some of them steady.
point::Problem any_driven(std::uint64_t index) {
  point::Problem scene = any_shaken(index);
  if (index % 3 == 0) scene.shaking = {};
  if (index % 3 == 0 && scene.oscillator.forcing == 0) scene.oscillator.forcing = 0.7;
  if (index % 5 == 1) scene.time = {};
  if (index % 4 == 2) scene.stops.stiffness_lower = 40, scene.stops.damping_lower = 0.1;
  return scene;
}

TEST(ImpactPhase, is_that_of_its_time_by_every_method) {
  std::size_t impacts = 0;
  for (std::uint64_t index = 0; index < 60; ++index)
    for (const auto method : {stepping::Method::exact, stepping::Method::dopri5, stepping::Method::moreau}) {
      point::Problem scene = any_driven(index);
      scene.integration.method = method;
      if (method != stepping::Method::exact) scene.time.window = 4, scene.time.max_periods = 8;
      const double nu = scene.oscillator.frequency, b = scene.shaking.stops + scene.shaking.base;
      for (const LoggedImpact& impact : impacts_of(scene)) {
        const double theta = nu * impact.time + scene.start.phase;
        // roundings of an angle of a few hundred at most
        EXPECT_NEAR(around_zero(impact.phase - theta), 0.0, 4e-13) << index << ' ' << impact.time;
        EXPECT_NEAR(impact.absolute, impact.before + b * nu * std::cos(theta), 1e-12 * (1 + std::abs(b) * nu)) << index;
        ++impacts;
      }
    }
  EXPECT_GT(impacts, 1000u);
}

TEST(ImpactPhase, of_a_mass_on_which_no_force_is_left_is_that_of_the_shaking) {
  // b nu^2 = -f: free motion in the frame of the base, whose section of a transient begins anywhere
  point::Problem scene = shaken({.forcing = -2, .frequency = 2}, {.base = 0.5}, {-0.5, 0.5, 1, 1});
  scene.start = {0.0, 1.0, 0.3};
  ASSERT_EQ(problem_at({.problem = scene}, 0).oscillator.forcing, 0.0);
  for (const bool steady : {false, true}) {
    scene.time = {};
    if (!steady) scene.time.mode = steady::Mode::transient, scene.time.duration = 9;
    const auto impacts = impacts_of(scene);
    ASSERT_GE(impacts.size(), 2u);
    for (const LoggedImpact& impact : impacts)
      EXPECT_NEAR(around_zero(impact.absolute - impact.before - std::cos(impact.phase)), 0.0, 1e-14);
    if (steady) continue;
    for (const LoggedImpact& impact : impacts)
      EXPECT_NEAR(around_zero(impact.phase - 2 * impact.time - 0.3), 0.0, 1e-14);
  }
}

TEST(ImpactPhase, does_not_exist_without_a_drive) {
  point::Problem scene = shaken({}, {}, {-0.5, 0.5, 1, 1});
  scene.start.velocity = 1;
  const auto impacts = impacts_of(scene);
  ASSERT_EQ(impacts.size(), 2u);
  for (const LoggedImpact& impact : impacts) {
    EXPECT_TRUE(std::isnan(impact.phase));
    EXPECT_EQ(impact.absolute, impact.before);
  }
}

TEST(ImpactPhase, of_the_mirror_image_is_half_a_turn_away) {
  std::size_t compared = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    point::Problem scene = any_driven(index);
    point::Problem mirrored = scene;
    mirrored.start = {-scene.start.displacement, -scene.start.velocity, scene.start.phase + pi_};
    mirrored.oscillator.load = -scene.oscillator.load;
    const Stops& stops = scene.stops;
    mirrored.stops = {-stops.upper,          -stops.lower,          stops.restitution_upper, stops.restitution_lower,
                      stops.stiffness_upper, stops.stiffness_lower, stops.damping_upper,     stops.damping_lower};
    scene.time.mode = mirrored.time.mode = steady::Mode::transient;
    scene.time.duration = mirrored.time.duration = 10 / scene.oscillator.frequency;
    const auto one = impacts_of(scene), other = impacts_of(mirrored);
    ASSERT_EQ(one.size(), other.size()) << index;
    for (std::size_t i = 0; i < one.size() && i < 5; ++i, ++compared) {
      // rounding of the start's phase, stretched by a few impacts
      EXPECT_NEAR(std::abs(around_zero(one[i].phase - other[i].phase)), pi_, 1e-9) << index << ' ' << i;
      EXPECT_NEAR(one[i].absolute, -other[i].absolute, 1e-9 * (1 + std::abs(one[i].absolute))) << index << ' ' << i;
    }
  }
  EXPECT_GT(compared, 60u);
}

TEST(ImpactPhase, of_a_soft_stop_is_that_of_the_touch) {
  // from x = 0 at rest in the frame of the table, under gravity alone onto a soft floor at -1/2: the touch is at tau =
  // 1
  point::Problem scene = shaken({.load = -1, .stiffness = 0.0}, {}, {-0.5, infinity, 1, 1, 30});
  scene.oscillator.forcing = 1e-300;
  scene.start.phase = 6.0;
  scene.time.mode = steady::Mode::transient, scene.time.duration = 2;
  const auto impacts = impacts_of(scene);
  ASSERT_EQ(impacts.size(), 1u);
  EXPECT_NEAR(impacts[0].phase, 7.0 - 2 * pi_, 1e-15);
  EXPECT_NEAR(impacts[0].before, -1.0, 1e-15);
}

}  // namespace
}  // namespace clatter::sweep::impact_phase_test
