#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "point/point.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep::shaking_test {
namespace {

/// A scene as it stands in the absolute frame: forces on the mass, and the place of what moves.
struct Moving {
  double h, f, nu, load, phase;
  double stops, base;  ///< amplitudes
  double lower, upper, R;
  double ahead = 0;  ///< of the motion of stops or base over the force

  [[nodiscard]] double place(double t) const { return (stops + base) * std::sin(nu * t + phase + ahead); }
  [[nodiscard]] double speed(double t) const { return (stops + base) * nu * std::cos(nu * t + phase + ahead); }
  /// y'' of the mass; a moving base pulls by spring and damper, moving stops don't.
  [[nodiscard]] double acceleration(double t, double y, double v) const {
    const double carried_x = base * std::sin(nu * t + phase + ahead),
                 carried_v = base * nu * std::cos(nu * t + phase + ahead);
    return f * std::sin(nu * t + phase) + load - 2 * h * (v - carried_v) - (y - carried_x);
  }
};

struct Absolute {
  double t, y, v;
};

/// A step of the classical Runge-Kutta method.
Absolute step(const Moving& m, const Absolute& s, double d) {
  const auto slope = [&](double t, double y, double v) { return std::array{v, m.acceleration(t, y, v)}; };
  const auto a = slope(s.t, s.y, s.v), b = slope(s.t + d / 2, s.y + d / 2 * a[0], s.v + d / 2 * a[1]),
             c = slope(s.t + d / 2, s.y + d / 2 * b[0], s.v + d / 2 * b[1]),
             e = slope(s.t + d, s.y + d * c[0], s.v + d * c[1]);
  return {s.t + d, s.y + d / 6 * (a[0] + 2 * b[0] + 2 * c[0] + e[0]),
          s.v + d / 6 * (a[1] + 2 * b[1] + 2 * c[1] + e[1])};
}

/// How far the mass is beyond a moving stop; negative between the stops.
double beyond(const Moving& m, const Absolute& s) {
  const double x = s.y - m.place(s.t);
  return std::max(m.lower - x, x - m.upper);
}

/// Near a graze the program and the reference may round to different sides.
constexpr double slowest_compared = 0.05;

struct Flown {
  Absolute end;
  int impacts = 0;
  double slowest = 1e9;  ///< relative speed of an impact
};

/// The original problem over a time, impacts located by bisection; nothing of it is shared with the program.
Flown integrate(const Moving& m, Absolute s, double duration) {
  constexpr double longest = 1e-3;  // its error over the test's time is below 1e-10
  Flown flown{s};
  while (duration - s.t > 1e-12 && flown.slowest >= slowest_compared) {  // a chatter would never end
    const double d = std::min(longest, duration - s.t);
    Absolute next = step(m, s, d);
    if (beyond(m, next) > 0) {
      double low = 0, high = d;
      for (int i = 0; i < 60; ++i) (beyond(m, step(m, s, (low + high) / 2)) > 0 ? high : low) = (low + high) / 2;
      next = step(m, s, low);
      const double relative = next.v - m.speed(next.t);
      next.v = m.speed(next.t) - m.R * relative;
      ++flown.impacts, flown.slowest = std::min(flown.slowest, std::abs(relative));
    }
    s = next;
  }
  flown.end = s;
  return flown;
}

point::PointResult run(const Moving& m, double x, double v, double duration) {
  Sweep sweep;
  GivenProblem& p = sweep.problem;
  p.oscillator = {.damping = m.h, .forcing = m.f, .frequency = m.nu, .load = m.load};
  p.stops = {m.lower, m.upper, m.R, m.R};
  p.start = {x, v, m.phase};
  p.shaking.stops = m.stops, p.shaking.base = m.base, p.shaking.phase = m.ahead;
  p.time.mode = steady::Mode::transient, p.time.duration = duration;
  p.observe.trajectory = 2;
  point::ThreadScratch scratch;
  return run_point(problem_at(sweep, 0), scratch);
}

TEST(Shaking, is_the_motion_between_moving_stops_or_on_a_moving_base) {
  std::mt19937 random(25);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const bool base = i % 2 == 0;
    const double b = between(-0.5, 0.5), f = i % 3 == 0 ? 0.0 : between(-1, 1);
    const Moving m{between(0, 0.3),
                   f,
                   between(0.3, 2.5),
                   between(-0.2, 0.2),
                   between(-7, 7),
                   base ? 0 : b,
                   base ? b : 0,
                   between(-1, -0.3),
                   between(0.3, 1),
                   between(0.3, 0.9),
                   i % 4 < 2 ? 0 : between(-4, 4)};
    const double x = between(-0.3, 0.3), v = between(-1, 1), duration = 12;
    const Flown expected = integrate(m, {0, x + m.place(0), v + m.speed(0)}, duration);
    if (expected.slowest < slowest_compared) continue;
    const point::PointResult result = run(m, x, v, duration);
    ASSERT_EQ(result.x.size(), 2u);
    EXPECT_EQ(result.impacts, expected.impacts) << i;
    // an impact of relative speed 0.05 magnifies the reference's error of 1e-11 by the acceleration over it, some 20
    EXPECT_NEAR(result.x[1], expected.end.y - m.place(duration), 1e-6) << i;
    EXPECT_NEAR(result.v[1], expected.end.v - m.speed(duration), 1e-6) << i;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(Shaking, of_amplitude_0_changes_no_bit) {
  Sweep sweep;
  sweep.problem.oscillator = {.damping = 0.1, .forcing = 0.7, .frequency = 1.3};
  sweep.problem.start.phase = 0.4;
  const point::Problem problem = problem_at(sweep, 0);
  EXPECT_EQ(problem.oscillator.forcing, 0.7);
  EXPECT_EQ(problem.start.phase, 0.4);
  EXPECT_EQ(problem.shaking.lead, 0.0);
}

TEST(Shaking, makes_a_force_where_there_is_none) {
  Sweep sweep;
  sweep.problem.oscillator.frequency = 2;
  sweep.problem.shaking.base = 0.5;
  EXPECT_EQ(problem_at(sweep, 0).oscillator.forcing, 2.0);  // b nu^2
  sweep.problem.shaking = {.stops = 0.5};
  EXPECT_EQ(problem_at(sweep, 0).oscillator.forcing, 1.5);  // -b (1 - nu^2), without damping in phase
}

TEST(Shaking, turns_the_section_with_the_start) {
  Sweep sweep;
  sweep.problem.oscillator = {.damping = 0.2, .forcing = 1, .frequency = 1.3};
  sweep.problem.shaking.stops = 0.5;
  sweep.problem.start.phase = sweep.problem.observe.section_phase = 0.3;
  const point::Problem problem = problem_at(sweep, 0);
  EXPECT_NE(problem.shaking.lead, 0.0);
  EXPECT_EQ(problem.start.phase, problem.observe.section_phase);
  EXPECT_EQ(problem.start.phase, 0.3 + problem.shaking.lead);
}

}  // namespace
}  // namespace clatter::sweep::shaking_test
