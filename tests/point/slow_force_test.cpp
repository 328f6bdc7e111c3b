// Forces far slower than the spring, under which the mass follows its equilibrium: a period takes about as many
// evaluations however long it is.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "point/point.hpp"

namespace clatter::point::slow_force_test {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Where a mass is that follows the force f s, three periods and an eighth after the start.
struct Slow {
  std::string name;
  Problem problem;
  double place;
  double lag = 1;         ///< over the frequency: the rate of the force times the damping
  double most = 100'000;  ///< evaluations
  double slowest = 1e-9;  ///< frequency
  double band = 0;        ///< within which a mass that sticks may be
};

Problem pushed(double f, double h, const Stops& stops) {
  Problem problem;
  problem.oscillator = {.damping = h, .forcing = f};
  problem.stops = stops;
  problem.time.mode = steady::Mode::transient;
  return problem;
}

std::vector<Slow> all() {
  const double eighth = std::sqrt(0.5);  // the sine there
  const Stops far{-10, 10, 0.7, 0.7};
  std::vector<Slow> slow;
  for (const double h : {0.02, 0.5, 1.0, 3.0}) {
    slow.push_back({"sine", pushed(-1, h, far), -eighth});
    slow.push_back({"friction", pushed(-1, h, far), -eighth + 0.01});
    slow.back().problem.friction = {0.01, 0.01};
    slow.push_back({"sticks", pushed(-1, h, far), -eighth + 0.1});
    slow.back().problem.friction = {0.1, 0.15}, slow.back().band = 0.15;
    slow.push_back({"soft stop", pushed(1, h, {-10, 0.5, 0.7, 0.7, none, 1.0, 0.0, 0.1}), (eighth + 0.5) / 2});
    slow.push_back({"soft stop, friction", slow.back().problem, (eighth + 0.5 - 0.01) / 2});
    slow.back().problem.friction = {0.01, 0.01};
    slow.push_back({"rest", pushed(1, h, {-0.5, 0.5, 0.7, 0.7}), 0.5});
    slow.push_back({"loose mass", pushed(1, h, {-none, none, 1, 1}), eighth});
    slow.back().problem.loose = {.ratio = 0.1, .lower = -1e3, .upper = 1e3};
    const auto shaped = [&](Waveform waveform, double s) {
      slow.push_back({"shape " + std::to_string(static_cast<int>(waveform)), pushed(1, h, far), s, 4});
      slow.back().problem.oscillator.shape.waveform = waveform;
    };
    shaped(Waveform::square, 1), shaped(Waveform::pulse, 1);
    for (const auto& [waveform, s] :
         {std::pair(Waveform::triangle, 0.5), {Waveform::sawtooth, -0.75}, {Waveform::half_sine, eighth}}) {
      shaped(waveform, s);  // the rounding of a transient that isn't apart bounds the steps
      slow.back().most = 1'000'000, slow.back().slowest = 1e-6;
    }
    shaped(Waveform::orders, (eighth + std::sin(3 * std::numbers::pi / 4)) / 2);
    slow.back().problem.oscillator.shape.orders.of[0] = {0.5, 0},
    slow.back().problem.oscillator.shape.orders.of[2] = {0.5, 0};
  }
  return slow;
}

TEST(SlowForce, takes_as_many_evaluations_however_slow_it_is) {
  ThreadScratch scratch;
  for (const Slow& slow : all())
    for (const double nu : {1e-3, 1e-6, 1e-9}) {
      if (nu < slow.slowest) continue;
      Problem problem = slow.problem;
      problem.oscillator.frequency = nu;
      problem.time.duration = 3.125 * period_of(problem.oscillator);
      const PointResult result = run_point(problem, scratch);
      const std::string name =
          slow.name + ", h = " + std::to_string(problem.oscillator.damping) + ", nu = " + std::to_string(nu);
      EXPECT_NEAR(result.end.displacement, slow.place,
                  slow.band + 1e-9 + 4 * slow.lag * (1 + problem.oscillator.damping) * nu)
          << name;
      EXPECT_LT(result.evaluations, slow.most) << name;
    }
}

}  // namespace
}  // namespace clatter::point::slow_force_test
