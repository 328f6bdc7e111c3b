// Periodic motion that touches a stop to within rounding: made by moving a stop onto an extremum of the steady
// response. Its derivative doesn't exist, which its status says.

#include <gtest/gtest.h>

#include <cmath>

#include "scene/response.hpp"
#include "support/random.hpp"
#include "sweep/figures.hpp"

namespace clatter::point::grazing_orbit_test {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();

/// The steady response of amplitude A from its start on, with a stop at A (1 + gap).
Problem beside_the_response(const Oscillator& oscillator, double gap, double R) {
  Problem scene;
  scene.oscillator = oscillator;
  const auto [P, Q, A] = steady_response(oscillator.damping, oscillator.forcing, oscillator.frequency);
  scene.stops = {-3 * A, A * (1 + gap), R, R};
  scene.start = {Q, oscillator.frequency * P, 0.0};
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.impacts = true;
  scene.observe.period = true;
  scene.observe.stability = true;
  scene.time.max_periods = 400;
  return scene;
}

TEST(GrazingOrbit, has_no_multipliers_and_says_so) {
  int grazing = 0, aperiodic = 0, other = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    support::Random random(31, i);
    const Oscillator oscillator{random.logarithmic(1e-2, 0.5), 1.0, random.logarithmic(0.3, 3), 0.0};
    const double gap = ulp * std::floor(random.uniform(-4, 5)), R = random.uniform(0.2, 1);
    ThreadScratch scratch;
    const PointResult result = run_point(beside_the_response(oscillator, gap, R), scratch);
    grazing += result.status == steady::Status::grazing, aperiodic += result.status == steady::Status::aperiodic;
    if (result.status == steady::Status::periodic) {  // grazes repel many motions to one that hits the stop
      ++other;
      EXPECT_GT(result.v_before[1], 1e-6) << i;
      continue;
    }
    EXPECT_NE(result.found_by, steady::FoundBy::newton) << i;
    EXPECT_TRUE(std::isnan(result.multiplier_re[0])) << i;
    if (result.status != steady::Status::grazing) continue;
    EXPECT_TRUE(std::isnan(result.lyapunov)) << i;
    EXPECT_GE(result.period_ratio, 1) << i;
  }
  EXPECT_GT(grazing, 100);
  std::cout << grazing << " grazing, " << aperiodic << " aperiodic, " << other << " that hit the stop\n";
}

TEST(GrazingOrbit, has_the_multipliers_of_free_motion_if_it_is_clear_of_the_stop) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    support::Random random(32, i);
    const double h = random.logarithmic(1e-2, 0.5), nu = random.logarithmic(0.3, 3);
    ThreadScratch scratch;
    const PointResult result = run_point(beside_the_response({h, 1.0, nu, 0.0}, 1e-11, 0.7), scratch);
    EXPECT_EQ(result.status, steady::Status::periodic) << i;
    const double modulus = std::hypot(result.multiplier_re[0], result.multiplier_im[0]);
    EXPECT_NEAR(modulus / std::exp(-h * 2 * pi<double>() / nu), 1, 1e-12) << i;
  }
}

TEST(GrazingOrbit, is_periodic_if_no_stability_is_asked_for) {
  Problem scene = beside_the_response({0.1, 1.0, 1.5, 0.0}, 2 * ulp, 0.7);
  scene.observe.stability = false;
  ThreadScratch scratch;
  EXPECT_EQ(run_point(scene, scratch).status, steady::Status::periodic);
}

TEST(GrazingOrbit, an_impact_that_is_slow_for_rounding_has_a_derivative_all_the_same_if_it_is_sure) {
  // one impact a period at 1e-3 of the usual speed: the derivative is large, but it exists
  ThreadScratch scratch;
  Problem scene;
  scene.oscillator = {0.1, -1.0, 1.0, 0.0}, scene.stops = {-0.5, 0.5, 0.7, 0.7};
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.period = true;
  scene.observe.stability = true;
  EXPECT_EQ(run_point(scene, scratch).status, steady::Status::periodic);
}

TEST(GrazingOrbit, is_none_that_the_force_takes_away_from_an_inelastic_stop) {
  // impacts of speed 0.81, after which hardly any speed is left, but the force pulls away from the stop
  for (const double R : {0.0, 1e-15, 1e-12, 1e-9, 1e-6}) {
    Problem scene;
    scene.oscillator = {0.05, 1.0, 2.4, 0.0};
    scene.stops = {0, std::numeric_limits<double>::infinity(), R, R};
    scene.observe = {};
    scene.observe.stability = scene.observe.impacts = true;
    ThreadScratch scratch;
    const PointResult result = run_point(scene, scratch);
    EXPECT_EQ(result.status, steady::Status::periodic) << R;
    EXPECT_NEAR(result.multiplier_re[0], -0.25923932, 5e-9 + 2 * R) << R;
    EXPECT_NEAR(result.multiplier_re[1], 0, 1e-15 + R) << R;
  }
}

}  // namespace
}  // namespace clatter::point::grazing_orbit_test
