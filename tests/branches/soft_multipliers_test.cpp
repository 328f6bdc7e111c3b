// Multipliers on branches between soft stops, against the derivative of the period map in 50 digits.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <string>

#include "branches/branch.hpp"
#include "branches/measures/measures.hpp"
#include "math/fifty_digits.hpp"
#include "support/runs.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::soft_multipliers_test {
namespace {

/// A state after a whole period.
struct End {
  FiftyDigits x, v;
};

/// The map over a period, in the frame of what is shaken.
class PeriodMap {
 public:
  PeriodMap(const point::Problem& given, const BranchPoint& point)
      : problem_(with_scene(given, point.scene)), turns_(point.orbit.period_ratio()) {
    sweep::enter_shaken_frame(problem_);
    problem_ = attractors::started(problem_, state_at_phase_zero(point.scene, point.orbit), 0.0);
  }

  [[nodiscard]] End operator()(const FiftyDigits& x, const FiftyDigits& v) const {
    const auto run = support::run_from<FiftyDigits>(problem_, x, v, turns_);
    EXPECT_EQ(run.outcome, stepping::Outcome::completed);
    return {run.end.x, run.end.v};
  }

  /// Its derivative by central differences. A damper that begins to push bends the map, so their error is of the order
  /// of the step, 1e-18, and rounding, 1e-50, adds 1e-32.
  [[nodiscard]] std::array<FiftyDigits, 4> derivative(const FiftyDigits& x, const FiftyDigits& v) const {
    const FiftyDigits step("1e-18");
    const End right = (*this)(x + step, v), left = (*this)(x - step, v), up = (*this)(x, v + step),
              down = (*this)(x, v - step);
    const FiftyDigits twice = 2 * step;
    return {(right.x - left.x) / twice, (up.x - down.x) / twice, (right.v - left.v) / twice, (up.v - down.v) / twice};
  }

 private:
  point::Problem problem_;
  FiftyDigits turns_;
};

struct Invariants {
  double trace, determinant;
};

Invariants invariants_of(const std::array<FiftyDigits, 4>& m) {
  return {static_cast<double>(m[0] + m[3]), static_cast<double>(m[0] * m[3] - m[1] * m[2])};
}

/// What was compared, and the largest error of a trace or a determinant over what is allowed.
struct Tested {
  int points = 0, events = 0, complex = 0;
  double worst = 0;
};

void compare(const point::Problem& problem, const BranchPoint& point, Tested& tested) {
  const PeriodMap map(problem, point);
  const PhasePoint state = state_at_phase_zero(point.scene, point.orbit);
  FiftyDigits x(state.x), v(state.v);
  const auto m = map.derivative(x, v);
  // Newton's step to the fixed point in 50 digits: the multipliers are those of the motion, not of its rounded state
  const End end = map(x, v);
  const FiftyDigits a = m[0] - 1, d = m[3] - 1, scale = a * d - m[1] * m[2], off_x = end.x - x, off_v = end.v - v;
  x -= (d * off_x - m[1] * off_v) / scale, v -= (a * off_v - m[2] * off_x) / scale;
  const Invariants rounded = invariants_of(m), exact = invariants_of(map.derivative(x, v));
  const auto& [re, im] = std::pair(point.multiplier_re, point.multiplier_im);
  const double trace = re[0] + re[1], determinant = re[0] * re[1] - im[0] * im[1];
  // the derivative is a product of a matrix or two of each event, which err by some ten ulps of the product of their
  // norms
  const double rounding = 256 * epsilon<double>() * static_cast<double>(1 + point.orbit.whole().size());
  double size = 1;
  for (const FiftyDigits& entry : m) size = std::max(size, static_cast<double>(abs(entry)));
  const auto error = [&](double mine, double at_rounded, double at_exact) {
    return std::abs(mine - at_exact) / (rounding * size + 2 * std::abs(at_rounded - at_exact));
  };
  const double worst = std::max(error(trace, rounded.trace, exact.trace),
                                error(determinant, rounded.determinant, exact.determinant) / size);
  EXPECT_LT(worst, 1) << point.orbit.word() << " at " << point.scene.oscillator.frequency;
  tested.worst = std::max(tested.worst, worst), ++tested.points;
  tested.events += static_cast<int>(point.orbit.size()), tested.complex += im[0] != 0;
}

/// Compares some points, evenly spread over those away from slow contacts and from special points: in a graze the
/// derivative jumps.
Tested compare_branch(const point::Problem& problem, const std::array<double, 2>& range, std::size_t count) {
  const Branches found = follow_branches(problem, {.range = range});
  std::vector<const BranchPoint*> points;
  for (const BranchPoint& point : found.points) {
    const auto slow = [](const OrbitEvent& impact) { return std::abs(impact.before) < 1e-3; };
    const auto is_there = [&](const SpecialPoint& special) {
      return std::abs(special.at.scene.oscillator.frequency - point.scene.oscillator.frequency) < 1e-9;
    };
    if (point.orbit.meets_soft_stop() && std::ranges::none_of(point.orbit.events, slow) &&
        std::ranges::none_of(found.special, is_there))
      points.push_back(&point);
  }
  Tested tested;
  EXPECT_GE(points.size(), count);
  for (std::size_t i = 0; i < count && i < points.size(); ++i)
    compare(problem, *points[i * points.size() / count], tested);
  std::cout << tested.points << " points of " << points.size() << ", " << tested.events << " events, " << tested.complex
            << " with complex multipliers; at most " << tested.worst << " of the allowed error\n";
  return tested;
}

point::Problem between(const Oscillator& oscillator, double gap, double kappa, double zeta) {
  point::Problem problem;
  problem.oscillator = oscillator;
  problem.stops = {-gap, gap};
  problem.stops.stiffness_lower = problem.stops.stiffness_upper = kappa;
  problem.stops.damping_lower = problem.stops.damping_upper = zeta;
  return problem;
}

TEST(SoftMultipliers, between_two_soft_stops_are_those_of_fifty_digits) {
  point::Problem problem = between({0.1, -1.0, 1.1, 0.0}, 3.0, 70.0, 0.1);
  problem.start = {2.0, 3.0, 0.0};
  const Tested tested = compare_branch(problem, {0.85, 1.5}, 8);
  EXPECT_GE(tested.events, 16);
}

TEST(SoftMultipliers, beside_a_rigid_stop_are_those_of_fifty_digits) {
  point::Problem problem = between({0.05, 1.0, 1.2, 0.1}, 0.6, 200.0, 0.3);
  problem.stops.stiffness_upper = std::numeric_limits<double>::infinity(), problem.stops.restitution_upper = 0.7;
  EXPECT_GE(compare_branch(problem, {1.0, 1.6}, 8).events, 16);
}

TEST(SoftMultipliers, without_a_spring_are_those_of_fifty_digits) {
  point::Problem problem = between({0.1, 1.0, 1.2, 0.0, 0.0}, 0.2, 500.0, 0.5);
  EXPECT_GE(compare_branch(problem, {1.0, 1.6}, 8).events, 16);
}

TEST(SoftMultipliers, with_an_unstable_spring_are_those_of_fifty_digits) {
  point::Problem problem = between({0.1, 1.0, 1.2, 0.0, -0.3}, 0.4, 100.0, 0.2);
  EXPECT_GE(compare_branch(problem, {1.0, 1.6}, 8).events, 16);
}

TEST(SoftMultipliers, between_shaken_overdamped_stops_are_those_of_fifty_digits) {
  point::Problem problem = between({0.1, 0.5, 1.2, 0.2}, 0.4, 20.0, 1.5);
  problem.shaking.stops = 0.5;
  EXPECT_GE(compare_branch(problem, {1.0, 1.6}, 8).events, 16);
}

}  // namespace
}  // namespace clatter::branches::soft_multipliers_test
