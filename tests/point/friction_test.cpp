#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "point/point.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/required_effects.hpp"
#include "scene/response.hpp"
#include "support/random.hpp"

namespace clatter::point {
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

double farthest(const Problem& problem) {
  ThreadScratch scratch;
  const PointResult result = run_point(problem, scratch);
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

}  // namespace
}  // namespace clatter::point
