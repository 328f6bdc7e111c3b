// Curves of special points in two parameters under dry friction, against closed forms and branches along one of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "branches/curve.hpp"
#include "branches/special_values.hpp"

namespace clatter::branches::friction_curve_test {
namespace {

using std::numbers::pi;

sweep::GivenProblem rubbing(double h, double nu, double mu, double stop, double R) {
  sweep::GivenProblem problem;
  problem.oscillator = {h, 1.0, nu, 0.0, 1.0};
  problem.stops = {-stop, stop, R, R};
  problem.friction.kinetic = mu;
  return problem;
}
sweep::GivenProblem soft(sweep::GivenProblem problem) {
  problem.stops.restitution_lower = problem.stops.restitution_upper = 1;
  problem.stops.stiffness_lower = problem.stops.stiffness_upper = 20;
  problem.stops.damping_lower = problem.stops.damping_upper = 0.2;
  return problem;
}

BranchSettings over(std::array<double, 2> nu, Parameter across, std::array<double, 2> range, std::string curve) {
  return {.range = nu, .across = across, .across_range = range, .curve = std::move(curve), .generations = 1};
}

/// Without a damper the mass turns at the amplitude of Den Hartog (1931): the graze is where that is the gap.
TEST(FrictionCurve, of_grazes_has_the_amplitude_of_Den_Hartog) {
  const double gap = 2.5;
  for (const bool is_soft : {false, true}) {
    sweep::GivenProblem problem = rubbing(0.0, 0.76, 0.3, gap, 0.7);
    if (is_soft) problem = soft(problem);
    const Branches found = follow_curves(problem, over({0.72, 0.95}, Parameter("friction"), {0.1, 0.5}, "graze"));
    std::size_t compared = 0;
    for (const BranchPoint& point : found.points) {
      if (point.branch != 0) continue;
      const double nu = point.scene.oscillator.frequency, mu = point.scene.friction.kinetic;
      const double V = 1 / (1 - nu * nu), U = std::sin(pi / nu) / (nu * (1 + std::cos(pi / nu)));
      EXPECT_NEAR(std::sqrt(V * V - mu * mu * U * U), gap, 1e-11) << nu << ' ' << mu;
      ++compared;
    }
    EXPECT_GT(compared, 20);
  }
}

double nearest(const std::vector<double>& values, double value) {
  double least = std::numeric_limits<double>::infinity();
  for (const double each : values) least = std::min(least, std::abs(each - value));
  return least;
}

/// A branch along the frequency, at the other parameter's value of a point of the curve, has the special point there.
/// It begins with the motion that the scene settles on, and not with anything of the curve.
void expect_special_points_of_branches(const sweep::GivenProblem& problem, const BranchSettings& settings,
                                       SpecialKind kind) {
  const Branches found = follow_curves(problem, settings);
  std::vector<const BranchPoint*> points;
  for (const BranchPoint& point : found.points)
    if (point.branch == found.points.front().branch) points.push_back(&point);
  ASSERT_GT(points.size(), 8) << settings.curve;
  for (const double at : {0.2, 0.4, 0.6, 0.8}) {
    const BranchPoint& point = *points[static_cast<std::size_t>(at * static_cast<double>(points.size()))];
    sweep::GivenProblem there = problem;
    set(there, *settings.across, value_of(point.scene, *settings.across));
    const Branches along = follow_branches(there, {.range = settings.range, .generations = 1});
    const std::vector<double> values = special_values(along, kind, Parameter("nu"));
    EXPECT_LT(nearest(values, point.scene.oscillator.frequency), 1e-9)
        << settings.curve << ' ' << value_of(point.scene, *settings.across);
  }
}

TEST(FrictionCurve, has_the_special_points_of_branches_that_it_crosses) {
  const sweep::GivenProblem rigid = rubbing(0.05, 1.3, 0.2, 0.5, 0.7);
  for (const auto& [across, range] :
       {std::pair(Parameter("friction"), std::array{0.15, 0.25}), std::pair(Parameter("xs"), std::array{0.4, 0.6})}) {
    expect_special_points_of_branches(rigid, over({1.0, 1.6}, across, range, "symmetry breaking"),
                                      SpecialKind::symmetry_breaking);
    expect_special_points_of_branches(rigid, over({0.5, 3.0}, across, range, "graze"), SpecialKind::graze);
  }
}

}  // namespace
}  // namespace clatter::branches::friction_curve_test
