#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>

#include "point/point.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/required_effects.hpp"
#include "scene/response.hpp"
#include "support/random.hpp"

namespace clatter::point::friction_test {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// On the response to the force, between stops that it doesn't meet.
Problem on_response(const Oscillator& oscillator, double friction) {
  Problem problem;
  problem.oscillator = oscillator;
  problem.stops = {-none, none, 1, 1};
  problem.friction = {friction, friction};
  const PhasePoint start = response_at(oscillator, 0, 1);
  problem.start = {start.x, start.v, 0};
  problem.time.mode = steady::Mode::transient;
  problem.time.duration = 500;
  problem.observe.extrema = true;
  return problem;
}

PointResult run(const Problem& problem) {
  ThreadScratch scratch;
  return run_point(problem, scratch);
}

double farthest(const Problem& problem) {
  const PointResult result = run(problem);
  return std::max(std::abs(result.x_min), std::abs(result.x_max));
}

TEST(Friction, carries_a_mass_beyond_the_response_without_it) {
  const Oscillator o{.damping = 0.01, .forcing = 1, .frequency = 0.5436};
  EXPECT_NEAR(farthest(on_response(o, 0.1817)) / steady_response(o).amplitude, 1.18, 0.005);
}

TEST(Friction, never_carries_it_beyond_the_bound_that_keeps_stops_in_reach) {
  int beyond_the_response = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    support::Random random(4711, i);
    const Oscillator o{.damping = random.logarithmic(1e-2, 2),
                       .forcing = 1,
                       .frequency = random.logarithmic(0.2, 3),
                       .stiffness = random.happens(0.5) ? 1.0 : random.logarithmic(0.2, 5)};
    const Problem problem = on_response(o, random.uniform(0, 1));
    const double farthest_place = farthest(problem);
    EXPECT_LE(farthest_place, requirements_of(problem).free_reach) << i;
    beyond_the_response += farthest_place > steady_response(o).amplitude * (1 + 1e-9) ? 1 : 0;
  }
  EXPECT_GT(beyond_the_response, 10);
}

/// Steady motion that turns round twice in a forcing period without sticking.
Problem swinging(double static_level) {
  Problem problem;
  problem.oscillator = {.damping = 0.05, .forcing = 1, .frequency = 0.8};
  problem.stops = {-none, none, 0.7, 0.7};
  problem.friction = {0.3, static_level};
  problem.observe.extrema = problem.observe.stability = true;
  return problem;
}

/// Of a problem that starts on the motion that another one has settled to.
PointResult run_from(const PointResult& settled, Problem problem) {
  problem.start = {settled.end.displacement, settled.end.velocity, settled.end.phase};
  return run(problem);
}
/// To rounding: each run is two periods nearer.
PointResult settled_swing() {
  PointResult settled = run(swinging(0.3));
  for (int more = 0; more < 20; ++more) settled = run_from(settled, swinging(0.3));
  return settled;
}

/// e^(-2hT) prod a+/a- = e^(-0.1 T) (a+/a-)^2.
TEST(Friction, shrinks_areas_at_each_reversal) {
  const PointResult result = run(swinging(0.3));
  const std::complex<double> first(result.multiplier_re[0], result.multiplier_im[0]),
      second(result.multiplier_re[1], result.multiplier_im[1]);
  EXPECT_NEAR(std::abs(first * second), 0.20139584, 5e-9);
}

TEST(Friction, leaves_no_derivative_where_a_turning_point_lies_on_a_stop) {
  const PointResult settled = settled_swing();
  Problem problem = swinging(0.3);
  problem.stops.upper = settled.x_max + 1e-13;
  EXPECT_EQ(run_from(settled, problem).status, steady::Status::grazing);
  problem.stops.upper = settled.x_max + 1e-6;
  EXPECT_EQ(run_from(settled, problem).status, steady::Status::periodic);
}

/// The force on the mass, friction apart, where it turns back at x: the slip down from there lasts half a period, and
/// its free motion (y, w) about the equilibrium mu ends in -x, with the response (r, s) turned to (-r, -s).
double push_at_turn(const Problem& problem, double x) {
  const double h = problem.oscillator.damping, nu = problem.oscillator.frequency, mu = problem.friction.kinetic;
  const double T = std::acos(-1.0) / nu, root = std::sqrt(1 - h * h), e = std::exp(-h * T);
  const double b = e * std::sin(root * T) / root, cosine = e * std::cos(root * T);
  const double a = cosine + h * b, c = cosine - h * b, determinant = (1 + a) * (1 + c) + b * b;
  const double y = -2 * mu * (1 + c) / determinant, w = -2 * mu * b / determinant;
  const double r = x - mu - y, s = -w;
  return (1 - nu * nu) * r + 2 * h * s - x;  // f sin(theta) of the response, less the spring
}

/// At a static level above the force there the mass sticks, and is let go later: motion jumps.
TEST(Friction, leaves_no_derivative_where_a_reversal_just_sticks_and_motion_jumps) {
  const PointResult settled = settled_swing();
  const double push = std::abs(push_at_turn(swinging(0.3), settled.x_max));
  EXPECT_EQ(run_from(settled, swinging(push)).status, steady::Status::grazing);
  EXPECT_EQ(run_from(settled, swinging(push * (1 - 1e-6))).status, steady::Status::periodic);
}

}  // namespace
}  // namespace clatter::point::friction_test
