// A mass that dry friction nearly holds, or hardly brakes: it creeps to where it is held, settles slowly, or grows.

#include "scene/creep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "point/point.hpp"
#include "support/random.hpp"

namespace clatter::point::creep_test {
namespace {

using steady::FoundBy;
using steady::Status;

constexpr double none = std::numeric_limits<double>::infinity();

Problem rubbing(const Oscillator& oscillator, double friction, double static_level, double x0) {
  Problem problem;
  problem.oscillator = oscillator;
  problem.stops = {-none, none, 1, 1};
  problem.friction = {friction, static_level};
  problem.start.displacement = x0;
  problem.observe.extrema = problem.observe.word = problem.observe.attractor = true;
  return problem;
}

PointResult run(const Problem& problem) {
  ThreadScratch scratch;
  return run_point(problem, scratch);
}

/// The displacement after so many forcing periods.
double place_after(Problem problem, double periods) {
  problem.time.mode = steady::Mode::transient;
  problem.time.duration = periods * period_of(problem.oscillator);
  return run(problem).end.displacement;
}

/// Friction 1.05 holds a mass against the force 1 where the spring pulls by 0.05 at most.
TEST(Creep, is_told_of_a_mass_beyond_the_band_in_which_friction_holds_it_for_good) {
  for (int i = -10; i <= 10; ++i) {
    const double x0 = i / 10.0;
    const PointResult result = run(rubbing({0.05, 1, 1}, 1.05, 1.05, x0));
    if (result.status == Status::periodic) {
      EXPECT_LE(std::abs(result.x_max), 0.05) << x0;
      continue;
    }
    EXPECT_EQ(result.status, Status::creeping) << x0;
    EXPECT_EQ(result.found_by, FoundBy::creep) << x0;
    EXPECT_NEAR(std::abs(result.x_max), 0.05, 1e-15) << x0;
    EXPECT_EQ(result.x_min, result.x_max) << x0;
    EXPECT_EQ(result.attractor_periods, 1) << x0;
    EXPECT_LT(result.periods, 200) << x0;
  }
}

/// The way that is left falls like 1/n, by 4.5/(f nu^2) of its square a period, whatever the spring and the load: a
/// run of n periods isn't there, nor beyond.
TEST(Creep, the_way_that_is_left_falls_like_the_inverse_of_the_time) {
  int creeping = 0;
  for (std::uint64_t i = 0; i < 24; ++i) {
    support::Random random(65, i);
    const double nu = random.logarithmic(0.3, 3), f = random.logarithmic(0.3, 3), k = random.logarithmic(0.2, 4),
                 mu = f * random.uniform(1, 1.5);
    const Problem problem =
        rubbing({random.uniform(0, 2), f * random.sign(), nu, random.uniform(-1, 1), k}, mu, mu, random.uniform(-3, 3));
    const PointResult result = run(problem);
    if (result.status != Status::creeping) {
      EXPECT_EQ(result.found_by, FoundBy::standstill) << i;
      continue;
    }
    ++creeping;
    const double edge = result.x_max, n = 20000;
    EXPECT_NEAR(std::abs(problem.oscillator.load - k * edge), mu - f, 1e-14 * (1 + mu)) << i;
    const double side = edge > problem.oscillator.load / k ? 1 : -1, before = place_after(problem, n / 2),
                 after = place_after(problem, n);
    EXPECT_GT(side * (after - edge), 0) << i;
    EXPECT_LT(side * after, side * before) << i;
    const double rate = (1 / (k * side * (after - edge)) - 1 / (k * side * (before - edge))) / (n / 2);
    EXPECT_NEAR(rate / (4.5 * k / (f * nu * nu)), 1, 0.05) << i;
  }
  EXPECT_GT(creeping, 8);
}

/// Where the force takes it over the static level, the mass jumps by a finite way, and sticks in the band.
TEST(Creep, needs_friction_that_is_no_larger_at_rest) {
  for (const double x0 : {-0.9, -0.3, 0.2, 0.7}) {
    const PointResult result = run(rubbing({0.05, 1, 1}, 1.0, 1.05, x0));
    EXPECT_EQ(result.found_by, FoundBy::standstill) << x0;
  }
}

TEST(Creep, ends_at_a_stop_on_its_way) {
  Problem problem = rubbing({0.05, 1, 1}, 1.05, 1.05, 0.9);
  problem.stops = {0.2, 2, 0.5, 0.5};
  const PointResult result = run(problem);
  EXPECT_EQ(result.status, Status::periodic);
  EXPECT_EQ(result.x_min, 0.2);
}

TEST(Creep, in_contact_with_a_soft_stop_is_told_with_both_springs) {
  Problem problem = rubbing({0.05, 1, 1, 0.5}, 1.05, 1.05, 0.23);
  problem.stops = {-none, 0.1, 1, 1};
  problem.stops.stiffness_upper = 3, problem.stops.damping_upper = 0.2;
  const PointResult result = run(problem);
  EXPECT_EQ(result.status, Status::creeping);
  EXPECT_NEAR(result.x_max, (0.5 + 0.05 + 3 * 0.1) / 4, 1e-15);  // load - k x - kappa (x - 0.1) = -0.05
}

/// In each half period the force adds pi f/2 to the swing, and friction takes 2 mu.
TEST(Resonance, without_damping_grows_for_ever_if_friction_is_below_a_quarter_of_pi_of_the_force) {
  for (const double k : {1.0, 0.36, 2.7}) {
    const Oscillator o{.forcing = -1.3, .frequency = std::sqrt(k), .load = 0.4, .stiffness = k};
    const double limit = pi<double>() / 4 * 1.3;
    for (const double x0 : {0.0, 3.0}) {
      EXPECT_EQ(run(rubbing(o, 0.999 * limit, 0.999 * limit, x0)).status, Status::escaped) << k;
      EXPECT_NE(run(rubbing(o, 1.001 * limit, 1.001 * limit, x0)).status, Status::escaped) << k;
    }
    const Problem grows = rubbing(o, 0.9 * limit, 0.9 * limit, 0);
    EXPECT_GT(std::abs(place_after(grows, 400)), 1.8 * std::abs(place_after(grows, 200))) << k;
    Problem bounded = grows;
    bounded.stops = {-5, 5, 0.7, 0.7};
    EXPECT_NE(run(bounded).status, Status::escaped) << k;
    Problem damped = grows;
    damped.oscillator.damping = 1e-3;
    EXPECT_NE(run(damped).status, Status::escaped) << k;
  }
}

TEST(Resonance, grows_from_a_start_that_a_higher_static_level_cannot_hold) {
  const Oscillator o{.forcing = 1, .frequency = 1};
  EXPECT_EQ(run(rubbing(o, 0.5, 1.2, 0)).found_by, FoundBy::standstill);
  EXPECT_EQ(run(rubbing(o, 0.5, 1.2, -9)).status, Status::escaped);
}

/// The steady motion of f = 1 under friction 0.001 differs from the response without it by 0.001 or so, and is
/// settled on as slowly.
TEST(SlightFriction, has_its_slow_motion_found_by_newtons_method) {
  for (int i = 0; i <= 30; ++i) {
    Problem problem = rubbing({0.001, 1, 1.5 + i / 20.0}, 0.001, 0.001, 0);
    problem.stops = {-1, 1, 0.7, 0.7};
    problem.observe.stability = true;
    const PointResult result = run(problem);
    EXPECT_EQ(result.status, Status::periodic) << i;
    Problem longer = problem;
    longer.start = result.end;
    longer.time.mode = steady::Mode::transient;
    longer.time.duration = 1000 * result.observed_turns * period_of(problem.oscillator);
    const PointResult later = run(longer);
    EXPECT_NEAR(later.end.displacement, result.end.displacement, 1e-10) << i;
    EXPECT_NEAR(later.end.velocity, result.end.velocity, 1e-10) << i;
  }
}

}  // namespace
}  // namespace clatter::point::creep_test
