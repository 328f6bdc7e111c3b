// The scene that 50 digits decide is the one that the user gave: its units and its frame round nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "point/in_fifty_digits.hpp"
#include "point/point.hpp"
#include "support/random.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep::given_digits_test {
namespace {

using boost::multiprecision::abs;

GivenProblem given() {
  GivenProblem problem;
  problem.oscillator = {.damping = 0.07, .forcing = 0.9, .frequency = 1.3, .load = 0.2, .stiffness = 1.7};
  problem.stops = {-0.5, 0.7, 0.8, 0.6, std::numeric_limits<double>::infinity(), 90.0, 0, 0.3};
  problem.friction = {0.05, 0.11};
  problem.start.phase = 0.4;
  return problem;
}

void expect_near(const FiftyDigits& number, const FiftyDigits& exact) {
  EXPECT_LE(static_cast<double>(abs(number - exact)), 1e-47 * std::abs(static_cast<double>(exact)));
}

TEST(GivenDigits, of_a_scene_with_any_spring) {
  const point::Problem problem = computed(given());
  const BasicScene<FiftyDigits> scene = point::in_fifty_digits(problem);
  const FiftyDigits k = 1.7, T = 1 / sqrt(k);
  expect_near(scene.oscillator.stiffness, 1);
  expect_near(scene.oscillator.damping, 0.07 * T);
  expect_near(scene.oscillator.forcing, 0.9 / k);
  expect_near(scene.oscillator.frequency, 1.3 * T);
  expect_near(scene.oscillator.load, 0.2 / k);
  expect_near(scene.friction.kinetic, 0.05 / k);
  expect_near(scene.friction.static_level, 0.11 / k);
  expect_near(scene.stops.stiffness_upper, 90 / k);
  EXPECT_EQ(scene.stops.damping_upper, FiftyDigits(0.3));
  EXPECT_EQ(scene.stops.upper, FiftyDigits(0.7));
  EXPECT_EQ(scene.start.phase, FiftyDigits(problem.start.phase));
}

TEST(GivenDigits, of_a_machine) {
  GivenProblem machine = given();
  machine.is_si = true, machine.mass = 0.3, machine.damper = 1.1, machine.oscillator.damping = 0;
  machine.oscillator.stiffness = 810, machine.oscillator.frequency = 9.7, machine.oscillator.forcing = 41;
  machine.stops.damping_upper = 0, machine.stops.stiffness_upper = 7000, machine.stop_damper_upper = 2.3;
  machine.stop_restitution_lower = 1;
  const BasicScene<FiftyDigits> scene = point::in_fifty_digits(computed(machine));
  const FiftyDigits m = 0.3, K = 810, T = sqrt(m / K), two_pi = 2 * pi<FiftyDigits>();
  expect_near(scene.oscillator.damping, 1.1 * T / (2 * m));
  expect_near(scene.oscillator.forcing, 41 / K);
  expect_near(scene.oscillator.frequency, two_pi * 9.7 * T);
  expect_near(scene.friction.kinetic, 0.05 / K);
  const FiftyDigits kappa = 7000 * T * T / m;
  expect_near(scene.stops.stiffness_upper, kappa);
  expect_near(scene.stops.damping_upper, 2.3 * T / (2 * m * sqrt(kappa)));
}

TEST(GivenDigits, of_a_shaken_base) {
  GivenProblem shaken = given();
  shaken.shaking = {.base = 0.21, .phase = 0.6};
  const BasicScene<FiftyDigits> scene = point::in_fifty_digits(computed(shaken));
  const FiftyDigits k = 1.7, nu = 1.3 / sqrt(k), inertia = 0.21 * nu * nu, f = 0.9 / k;
  const FiftyDigits in_phase = f + inertia * cos(FiftyDigits(0.6)), quadrature = inertia * sin(FiftyDigits(0.6));
  expect_near(scene.oscillator.forcing, sqrt(in_phase * in_phase + quadrature * quadrature));
}

/// Rounding of the computed scene is far below all that a double can tell of one number.
TEST(GivenDigits, are_those_of_the_computed_scene_to_its_rounding) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    support::Random random(64, i);
    GivenProblem any = given();
    any.oscillator.stiffness = random.logarithmic(0.1, 10) * random.sign();
    any.shaking = {.base = random.happens(0.5) ? random.uniform(0, 1) : 0.0};
    const point::Problem problem = computed(any);
    const Scene rounded = with_numbers<double>(point::in_fifty_digits(problem));
    EXPECT_NEAR(rounded.oscillator.forcing, problem.oscillator.forcing, 1e-15 * std::abs(problem.oscillator.forcing));
    EXPECT_NEAR(rounded.oscillator.frequency, problem.oscillator.frequency, 1e-15 * problem.oscillator.frequency);
    EXPECT_NEAR(rounded.oscillator.damping, problem.oscillator.damping, 1e-15 * problem.oscillator.damping);
    EXPECT_EQ(rounded.stops.lower, problem.stops.lower);
  }
}

/// Motion over an unstable spring that rests on its upper stop: a run from the release of rest has the period 70, as
/// runs of another integrator in __float128 and in 50 digits have. The scene that is computed has the period 57, since
/// 1/|k|^(1/2) has been rounded.
TEST(GivenDigits, decide_the_period_of_motion_that_rests) {
  GivenProblem problem;
  problem.oscillator = {.forcing = 1, .frequency = 4.099638687172832, .stiffness = -0.1644922369857774};
  problem.friction = {0.08274310923932078, 0.4780902385446347};
  problem.stops = {-1.0414278648206192, 1.4159848491625429, 0.48756032562118345, 0.48756032562118345};
  problem.time.max_periods = 3000;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(computed(problem), scratch);
  EXPECT_EQ(result.status, steady::Status::aperiodic);
  EXPECT_EQ(result.found_by, steady::FoundBy::rests);
  point::Problem rounded = computed(problem);
  rounded.given.reset();
  EXPECT_EQ(run_point(rounded, scratch).observed_turns, 57);
}

}  // namespace
}  // namespace clatter::sweep::given_digits_test
