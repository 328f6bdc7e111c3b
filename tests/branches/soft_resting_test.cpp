// Motion that rests on a rigid stop beside a soft one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "attractors/exact_run.hpp"
#include "branches/branch.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/special_values.hpp"
#include "branches/start/resting.hpp"
#include "support/soft_scene.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::soft_resting_test {
namespace {

constexpr double rigid = std::numeric_limits<double>::infinity();

/// A random soft lower stop and a rigid upper one, against which a load presses.
point::Problem mixed_scene(std::uint64_t index) {
  point::Problem problem = support::soft_scene(index);
  Stops& stops = problem.stops;
  stops.upper = std::min(std::abs(stops.lower), 0.4);
  stops.stiffness_upper = rigid, stops.damping_upper = 0, stops.restitution_upper = 0.1 + 0.05 * double(index % 9);
  problem.oscillator.load = stops.upper * problem.oscillator.stiffness + 0.3 * std::abs(problem.oscillator.forcing);
  problem.time = {};
  problem.time.max_periods = 500;
  return problem;
}

Branches branches_of(const point::Problem& problem) {
  const double nu = problem.oscillator.frequency;
  try {
    return follow_branches(problem, {.range = {0.8 * nu, 1.25 * nu}, .max_points = 300});
  } catch (const StartError&) {
    return {};
  }
}

/// A rest erases the past: after a period the run of the integrator is in the same state, but for rounding.
TEST(SoftResting, is_a_fixed_point_of_the_integrator) {
  std::size_t resting = 0, soft = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    const point::Problem problem = mixed_scene(index);
    if (problem.oscillator.forcing == 0) continue;
    const Branches found = branches_of(problem);
    for (std::size_t i = 1; i + 1 < found.points.size(); ++i) {
      const BranchPoint& point = found.points[i];
      if (!point.orbit.rests()) continue;
      if (found.points[i - 1].branch != point.branch || found.points[i + 1].branch != point.branch) continue;
      const PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
      const auto to = attractors::state_after(attractors::started(with_scene(problem, point.scene), from, 0.0),
                                              point.orbit.period_ratio());
      ASSERT_TRUE(to) << index;
      EXPECT_LT(std::hypot(to->x - from.x, to->v - from.v), 1e-9) << index << ' ' << point.orbit.word();
      ++resting, soft += point.orbit.meets_soft_stop();
    }
  }
  EXPECT_GT(resting, 300);
  EXPECT_GT(soft, 100);
}

/// The derivative of the loss by the frequency, and its difference quotient, of fourth order in the distance.
TEST(SoftResting, has_the_derivative_of_its_loss) {
  std::size_t compared = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    const point::Problem problem = mixed_scene(index);
    if (problem.oscillator.forcing == 0) continue;
    for (const BranchPoint& point : branches_of(problem).points) {
      if (!point.orbit.rests() || !point.orbit.meets_soft_stop() || compared > 300) continue;
      const double nu = point.scene.oscillator.frequency, step = 1e-4;
      const auto power = [&](double there) -> std::optional<double> {
        const FollowedScene scene = changed(point.scene, Parameter("nu"), there);
        const auto orbit = resting_orbit(with_scene(problem, scene), Side::upper, point.orbit.half_turns / 2);
        if (!orbit || letters_of(*orbit) != letters_of(point.orbit) || orbit->size() != point.orbit.size()) return {};
        return impact_power(scene, *orbit);
      };
      const auto a = power(nu - 2 * step), b = power(nu - step), c = power(nu + step), d = power(nu + 2 * step);
      if (!a || !b || !c || !d) continue;
      const Along along = impact_power(moving_from_release(point.scene, point.orbit, Parameter("nu")));
      EXPECT_NEAR(along.value, impact_power(point.scene, point.orbit), 1e-12 * (1 + along.value));
      // where a graze is near, the loss turns sharply
      const double by_difference = (8 * (*c - *b) - (*d - *a)) / (12 * step), wide = (*d - *a) / (4 * step);
      EXPECT_NEAR(along.slope[0], by_difference, 1e-6 + 0.1 * std::abs(by_difference - wide)) << index;
      ++compared;
    }
  }
  EXPECT_GT(compared, 60);
}

/// A cascade of grazes towards rest on the rigid stop ends in its chatter limit. A rigid stop in place of the soft one
/// would hold the mass, too, and a rest forgets the contacts before it: all that is left of the soft one is the depth
/// that the force presses it to, which is as 1/kappa.
TEST(SoftResting, ends_a_cascade_in_the_chatter_limit_of_rigid_stops) {
  const auto limit = [](double kappa) {
    point::Problem problem;
    problem.oscillator = {0.16, -1.75, 0.53, 0.0};
    problem.stops = {-0.36, 0.97, 1.0, 0.6};
    const double zeta = 0.5, root = std::sqrt(1 - zeta * zeta);
    problem.stops.restitution_lower = std::exp(-2 * zeta * std::acos(zeta) / root);
    if (kappa < rigid) problem.stops.stiffness_lower = kappa, problem.stops.damping_lower = zeta;
    problem.start = {0.0, 0.15, 0.0};
    const Branches found = follow_branches(problem, {.range = {0.37, 0.74}, .max_points = 2000});
    EXPECT_TRUE(std::ranges::none_of(found.ends, &BranchEnd::failed)) << kappa;
    const std::vector<double> limits = special_values(found, SpecialKind::chatter_limit, Parameter("nu"));
    return limits.empty() ? std::numeric_limits<double>::quiet_NaN() : limits.front();
  };
  const double at = limit(rigid), near = limit(1e6) - at, nearer = limit(1e8) - at;
  EXPECT_LT(std::abs(nearer), 1e-6);
  EXPECT_NEAR(near / nearer, 100.0, 0.5);
}

/// Without a spring the motion between equal stops is symmetric about their middle, wherever it is: two contacts open
/// in one graze, and the branch goes on.
TEST(SoftResting, is_no_failure_without_a_spring_between_stops_about_another_middle) {
  point::Problem problem;
  problem.oscillator = {0.69, -1.06, 0.447, 0.0};
  problem.oscillator.stiffness = 0;
  problem.stops = {-0.77, 0.88};
  problem.stops.stiffness_lower = problem.stops.stiffness_upper = 2305;
  problem.start = {0.0, 0.5, 0.0};
  const Branches found = follow_branches(problem, {.range = {0.32, 0.6}, .max_points = 2000});
  EXPECT_TRUE(std::ranges::none_of(found.ends, &BranchEnd::failed));
  EXPECT_GT(special_values(found, SpecialKind::graze, Parameter("nu")).size(), 3);
}

/// Over 22 forcing periods of chaos between its rests rounding grows to the motion's own size.
TEST(SoftResting, that_rounding_decides_is_not_followed) {
  point::Problem problem;
  problem.oscillator = {0.016559510350001392, 0.2356115150232016, 0.4010821141105805, 0.0};
  problem.oscillator.stiffness = 0;
  problem.stops = {-0.1932332564798549, 0.6099473935822914, 0.75633526501225, 1.0};
  problem.stops.stiffness_upper = 20856.720790864838, problem.stops.damping_upper = 0.00782584883679119;
  problem.start = {-0.08456176007176974, 0.0, 0.0};
  problem.time = {}, problem.time.max_periods = 600;
  try {
    (void)follow_branches(problem, {.range = {0.28, 0.56}});
    ADD_FAILURE() << "it is followed";
  } catch (const StartError& error) {
    EXPECT_NE(std::string(error.what()).find("rounding decides it"), std::string::npos) << error.what();
  }
}

/// Without restitution a flight that turns into its stop as it begins is a landing that rests. A flight that only
/// touches the stop later is a graze, and comes before that: no branch passes it.
TEST(SoftResting, is_not_reached_through_a_graze) {
  point::Problem problem;
  problem.oscillator = {0.0055, 0.177, 0.531, 0.0};
  problem.oscillator.stiffness = 0.279;
  problem.stops = {-0.588, 0.588, 0.0, 1.0};
  problem.stops.stiffness_upper = 4735;
  problem.start = {0.504, 0.0, 0.0};
  const Branches found = follow_branches(problem, {.range = {0.372, 0.744}, .max_points = 1000});
  std::vector<std::size_t> passing;  // branches of one landing a period, at a frequency that they have in common
  for (std::size_t i = 0; i + 1 < found.points.size(); ++i) {
    const BranchPoint &one = found.points[i], &other = found.points[i + 1];
    const double from = one.scene.oscillator.frequency - 0.6, to = other.scene.oscillator.frequency - 0.6;
    if (one.branch == other.branch && (from < 0) != (to < 0) && one.orbit.word() == "LU") passing.push_back(one.branch);
  }
  EXPECT_EQ(passing.size(), 1);
  for (const BranchPoint& point : found.points) {
    const PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
    const auto there = attractors::started(with_scene(problem, point.scene), from, 0.0);
    const auto to = attractors::state_after(there, point.orbit.period_ratio());
    ASSERT_TRUE(to);
    // the map has a root at a graze
    EXPECT_LT(std::hypot(to->x - from.x, to->v - from.v), 1e-5) << point.scene.oscillator.frequency;
  }
}

}  // namespace
}  // namespace clatter::branches::soft_resting_test
