#include <gtest/gtest.h>

#include <cmath>

#include "point/point.hpp"
#include "scene/displacement_bound.hpp"

namespace clatter::attractors::settling_test {
namespace {

double settling_of(point::Problem problem) {
  problem.observe.settling = true;
  point::ThreadScratch scratch;
  return run_point(problem, scratch).settling_periods;
}

/// Without stops the distance from the response decays by exp(-h T) a period, turning by omega T: the periods after
/// which it stays below 1e-3 of the response at forcing phase 0 follow from the closed form.
TEST(Settling, of_linear_motion_is_that_of_the_closed_form) {
  for (const double nu : {0.3, 0.77, 1.0, 1.9}) {
    point::Problem problem;
    problem.oscillator = {.damping = 0.05, .forcing = 1.0, .frequency = nu};
    problem.start = {2.0, -1.0, 0.0};
    const double h = 0.05, omega = std::sqrt(1 - h * h), T = 2 * M_PI / nu;
    const PhasePoint response = response_at(problem.oscillator, 0.0, 1.0);
    const double x = 2.0 - response.x, v = -1.0 - response.v;
    const double limit = 1e-3 * std::max(std::abs(response.x), std::abs(response.v));
    double settled = 0;
    for (int k = 0; k < 400; ++k) {
      const double t = k * T, c = std::cos(omega * t), s = std::sin(omega * t), e = std::exp(-h * t);
      const double dx = e * (x * c + (v + h * x) / omega * s), dv = e * (v * c - (x + h * v) / omega * s);
      if (std::max(std::abs(dx), std::abs(dv)) > limit) settled = k + 1;
    }
    EXPECT_EQ(settling_of(problem), settled) << nu;
  }
}

TEST(Settling, is_zero_on_the_motion_itself_and_unknown_without_one) {
  point::Problem problem;
  problem.oscillator = {.damping = 0.1, .forcing = -1.0, .frequency = 1.2};
  problem.stops = {-3.0, 3.0, 0.7, 0.7};
  const PhasePoint response = response_at(problem.oscillator, 0.0, 1.0);
  problem.start = {response.x, response.v, 0.0};
  EXPECT_EQ(settling_of(problem), 0);
  problem.oscillator.frequency = 0.93;  // chaos
  problem.time.max_periods = 300;
  EXPECT_TRUE(std::isnan(settling_of(problem)));
}

/// Impacts included: by the states of the same run, looked at one by one.
TEST(Settling, of_motion_with_impacts_is_the_last_section_that_is_far_away) {
  for (const double nu : {0.868, 0.97, 1.05, 1.2}) {
    point::Problem problem;
    problem.oscillator = {.damping = 0.1, .forcing = -1.0, .frequency = nu};
    problem.stops = {-3.0, 3.0, 0.7, 0.7};
    problem.start = {-1.5, 3.0, 0.0};
    const double settled = settling_of(problem);
    constexpr int periods = 640, round = 64;  // of which every period here is a divisor
    problem.time.mode = steady::Mode::transient;
    problem.time.duration = periods * period_of(problem.oscillator) * (1 + 1e-12);
    problem.observe.section = periods;
    point::ThreadScratch scratch;
    const point::PointResult result = run_point(problem, scratch);
    ASSERT_EQ(result.section_x.size(), periods) << nu;
    double last = 0;
    for (int k = 0; k < periods; ++k) {
      const auto i = static_cast<std::size_t>(k), steady = static_cast<std::size_t>(periods - round + k % round);
      const double x = result.section_x[steady], v = result.section_v[steady];
      const double far = std::max(std::abs(result.section_x[i] - x), std::abs(result.section_v[i] - v));
      if (far > 1e-3 * std::max(std::abs(x), std::abs(v))) last = k + 1;
    }
    EXPECT_EQ(settled, last) << nu;
  }
}

}  // namespace
}  // namespace clatter::attractors::settling_test
