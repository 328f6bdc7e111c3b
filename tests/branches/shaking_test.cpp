// Branches with stops or a base that the force's frequency shakes, against the same motion under the force that they
// stand for.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "branches/branch.hpp"
#include "branches/equations/newton.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/special_values.hpp"
#include "branches/start/resting.hpp"
#include "branches/symmetric_motion.hpp"
#include "branches/walk/violation.hpp"
#include "point/point.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::shaking_test {
namespace {

point::Problem problem_of(double k, double f, const Shaking& shaking) {
  point::Problem problem;
  problem.oscillator = {0.1, f, 2.0, 0.0, k};
  problem.stops = {-0.5, 0.5, 0.7, 0.7};
  problem.start = {0.1, 1.0, 0.0};
  problem.shaking = shaking;
  problem.observe.energy = true;
  return problem;
}

/// The same motion under the force in the moving frame, whose phase leads that of the shaking.
std::pair<Scene, Orbit> under_force(const FollowedScene& shaken, Orbit orbit) {
  const auto [f, lead] = force_in_frame(shaken.oscillator, shaken.shaking);
  Scene scene = shaken;
  scene.oscillator.forcing = f, scene.shaking = {};
  for (OrbitEvent& impact : orbit.events) impact.phase += lead;
  return {scene, orbit};
}

/// Every motion of a branch solves the equations of the scene under that force, with the same multipliers.
void expect_motions_under_force(const Branches& found) {
  std::size_t compared = 0;
  for (const BranchPoint& point : found.points) {
    if (point.orbit.size() == 0) continue;
    const auto [scene, orbit] = under_force(point.scene, point.orbit);
    const double slowest =
        std::abs(std::ranges::min(orbit.events, {}, [](const OrbitEvent& i) { return std::abs(i.before); }).before);
    if (slowest < 1e-2) continue;  // ill-conditioned near a graze
    const OrbitEquations equations(scene, orbit, {}, 1.0);
    const auto at = equations.at(equations.unknowns_of(scene, orbit));
    ASSERT_TRUE(at);
    EXPECT_LT(largest(at->residual), 1e-12) << scene.oscillator.frequency;
    const ImpactMap one = impact_map(scene, orbit), other = impact_map(point.scene, point.orbit);
    EXPECT_NEAR(one.trace(), other.trace(), 1e-11 * (1 + std::abs(one.trace())) / slowest);
    EXPECT_FALSE(violation(scene, orbit));
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

/// Folds of symmetric motion are those of the closed form under that force, which changes along the branch.
void expect_folds(const Branches& found) {
  std::size_t folds = 0;
  for (const SpecialPoint& special : found.special) {
    if (special.kind != SpecialKind::fold || !special.at.orbit.mirrored || special.at.orbit.size() != 1) continue;
    const SymmetricMotion known(special.at.scene);
    EXPECT_NEAR(known.discriminant, 0.0, 2e-12 * known.square * known.gap * known.gap);
    ++folds;
  }
  EXPECT_GE(folds, 1);
}

TEST(ShakenBase, has_the_branch_of_the_force_that_grows_with_the_square_of_the_frequency) {
  const Branches found = follow_branches(problem_of(1.0, 0.0, {.base = 0.3}), {.range = {1.1, 6.0}});
  expect_motions_under_force(found);
  const std::vector<double> maxima = special_values(found, SpecialKind::impact_speed, Parameter("nu"));
  for (const BranchPoint& point : found.points) {  // by hand, at this frequency
    Scene scene = point.scene;
    const double nu = scene.oscillator.frequency;
    scene.oscillator.forcing = 0.3 * nu * nu, scene.shaking = {};
    if (point.orbit.size() == 0) continue;
    const OrbitEquations equations(scene, point.orbit, {}, 1.0);
    const auto at = equations.at(equations.unknowns_of(scene, point.orbit));
    ASSERT_TRUE(at);
    EXPECT_LT(largest(at->residual), 1e-12) << nu;
  }
}

TEST(ShakenBase, has_the_folds_of_the_closed_form) {
  // f shrinks the force of the base, so that the branch ends in a fold at high frequencies, too
  for (const double k : {1.0, 0.0, -0.3})
    expect_folds(follow_branches(problem_of(k, 1.0, {.base = -0.02}), {.range = {1.1, 6.0}}));
  expect_folds(follow_branches(problem_of(1.0, 1.0, {.base = 0.0}),
                               {.along = Parameter("base_amplitude"), .range = {-0.3, 0.5}}));
}

TEST(ShakenStops, have_the_branch_of_the_force_with_its_lead) {
  for (const double k : {1.0, 0.0, -0.3, 2.0}) {
    const Branches found = follow_branches(problem_of(k, 1.0, {.stops = 0.1}), {.range = {1.1, 4.0}});
    expect_motions_under_force(found);
  }
  expect_motions_under_force(
      follow_branches(problem_of(0.3, 0.8, {.stops = 0.05}), {.along = Parameter("stiffness"), .range = {-4.0, 12.0}}));
}

TEST(ShakenStops, have_the_folds_of_the_closed_form) {
  expect_folds(follow_branches(problem_of(1.0, 1.0, {.stops = -0.02}), {.range = {1.1, 6.0}}));
  expect_folds(follow_branches(problem_of(1.0, 1.0, {.stops = 0.0}),
                               {.along = Parameter("stop_amplitude"), .range = {-0.3, 0.5}}));
  // a negative force, whose amplitude in the frame changes sign with that of the stops
  expect_folds(follow_branches(problem_of(1.0, -1.0, {.stops = 0.0}),
                               {.along = Parameter("stop_amplitude"), .range = {-0.5, 0.3}}));
  expect_folds(follow_branches(problem_of(0.3, 0.8, {.stops = 0.02}), {.range = {1.1, 6.0}}));
}

/// By another way: `clatter run` finds the motion from its start, in its own units and at the phase of the shaking.
TEST(Shaken, branch_has_the_states_of_runs) {
  for (const Shaking shaking : {Shaking{.stops = 0.1}, {.base = 0.2}, {.stops = -0.1}})
    for (const double k : {1.0, 0.0, 4.0}) {
      point::Problem problem = problem_of(k, 1.2, shaking);
      problem.start.phase = 0.4;  // a start at another phase
      const Branches found = follow_branches(problem, {.range = {1.9, 2.1}});
      for (const BranchPoint& point : {found.points.front(), found.points.back()}) {
        if (!point.stable) continue;
        sweep::Sweep one{.problem = with_scene(problem, point.scene)};
        const PhasePoint state = state_at_phase_zero(point.scene, point.orbit);
        one.problem.start = {state.x, state.v, 0.0};
        one.problem.observe = {}, one.problem.observe.attractor = true, one.problem.observe.impacts = true;
        const point::Problem run = sweep::problem_at(one, 0);
        point::ThreadScratch scratch;
        const point::PointResult result = run_point(run, scratch);
        ASSERT_EQ(result.status, steady::Status::periodic);
        EXPECT_NEAR(result.attractor_x, state.x, 1e-10) << k;
        EXPECT_NEAR(result.attractor_v / run.units.time, state.v, 1e-10) << k;
        EXPECT_NEAR(result.attractor_periods, point.orbit.period_ratio(), 0.0) << k;
      }
    }
}

TEST(Shaken, measures_are_the_observables_of_a_run) {
  for (const Shaking shaking : {Shaking{.stops = 0.1}, {.base = 0.2}}) {
    point::Problem problem = problem_of(0.5, 0.8, shaking);
    observables::Observe& observe = problem.observe;
    observe.extrema = true, observe.harmonics = 1, observe.harmonics_method = observables::HarmonicsMethod::exact;
    point::Problem in_frame = problem;
    sweep::enter_shaken_frame(in_frame);
    point::ThreadScratch scratch;
    const point::PointResult run = run_point(in_frame, scratch);
    const Orbit orbit = start_orbit(problem, 0, true);
    const OrbitEquations equations(problem, orbit, {{Parameter("nu"), 1.0}}, 1.0);
    const Vector z = equations.unknowns_of(problem, orbit), still(z.size(), 0.0);
    EXPECT_NEAR(impact_power(moving(equations, z, still)).value, run.impact_power, 1e-12);
    EXPECT_NEAR(harmonic(moving(equations, z, still)).value, run.x_spectrum.amplitude[1], 1e-12);
    EXPECT_NEAR(extrema(problem, orbit).x_max, run.x_max, 1e-12);
  }
}

/// Rests on both stops in every period.
point::Problem resting(double k, const Shaking& shaking) {
  point::Problem problem;
  problem.oscillator = {0.1, 1.0, 0.3, 0.03, k};
  problem.stops = {-0.4, 0.4, 0.6, 0.6};
  problem.start = {0.0, 1.0, 0.0};
  problem.shaking = shaking;
  problem.observe.energy = true;
  return problem;
}

TEST(Shaken, resting_motion_is_that_of_a_run) {
  for (const double k : {1.0, 0.0, 0.4})
    for (const Shaking shaking : {Shaking{}, {.stops = 0.3}, {.base = 0.5}}) {
      point::Problem problem = resting(k, shaking), in_frame = problem;
      in_frame.observe.extrema = true, in_frame.observe.attractor = true;
      sweep::enter_shaken_frame(in_frame);
      point::ThreadScratch scratch;
      const point::PointResult run = run_point(in_frame, scratch);
      const auto orbit = resting_orbit(problem, Side::upper, 1);
      ASSERT_TRUE(orbit) << k;
      EXPECT_NEAR(impact_power(problem, *orbit), run.impact_power, 1e-12) << k;
      EXPECT_NEAR(extrema(problem, *orbit).v_max, run.v_max, 1e-12) << k;
      const PhasePoint state = state_at_phase_zero(problem, *orbit);
      EXPECT_NEAR(state.x, run.attractor_x, 1e-12) << k;
      EXPECT_NEAR(state.v, run.attractor_v, 1e-12) << k;
    }
}

TEST(MovingFromRelease, has_the_derivatives_of_differences_along_stiffness_and_amplitudes) {
  for (const auto& [along, k, shaking] : {std::tuple(Parameter("stiffness"), 1.0, Shaking{}),
                                          {Parameter("stiffness"), 0.4, {.stops = 0.3}},
                                          {Parameter("stop_amplitude"), 1.0, {.stops = 0.3}},
                                          {Parameter("stop_amplitude"), 1.0, {}},
                                          {Parameter("stop_phase"), 1.0, {.stops = 0.3, .phase = 0.4}},
                                          {Parameter("stop_phase"), 0.4, {.base = 0.5}},
                                          {Parameter("base_amplitude"), 0.0, {.base = 0.5}},
                                          {Parameter("nu"), 0.0, {.base = 0.5}},
                                          {Parameter("nu"), 1.0, {.stops = 0.3}},
                                          {Parameter("h"), 0.4, {.stops = 0.3}}}) {
    const point::Problem problem = resting(k, shaking);
    const auto at = [&, by = along](double change) {
      const FollowedScene scene = changed(problem, by, value_of(problem, by) + change);
      return std::pair(scene, resting_orbit(with_scene(problem, scene), Side::upper, 1).value());
    };
    const auto [scene, orbit] = at(0.0);
    const auto [scene_ahead, ahead] = at(1e-6);
    const auto [scene_behind, behind] = at(-1e-6);
    const Moving m = moving_from_release(scene, orbit, along);
    const double speed = (impact_speed(ahead) - impact_speed(behind)) / 2e-6;
    const double power = (impact_power(scene_ahead, ahead) - impact_power(scene_behind, behind)) / 2e-6;
    const auto name = along.key();
    EXPECT_NEAR(impact_speed(m).value, impact_speed(orbit), 1e-15) << name;
    EXPECT_NEAR(impact_speed(m).slope[0], speed, 1e-8) << name;
    EXPECT_NEAR(impact_power(m).slope[0], power, 1e-8) << name;
  }
}

TEST(ReleaseTangency, of_shaken_stops_is_where_spring_load_and_force_balance) {
  point::Problem problem = resting(0.5, {.stops = 0.3});
  problem.stops = {-std::numeric_limits<double>::infinity(), 0.2, 0.5, 0.5}, problem.oscillator.load = 0.45;
  problem.oscillator.frequency = 0.4;
  for (const Parameter along : {Parameter("stop_amplitude"), Parameter("nu"), Parameter("f"), Parameter("load")}) {
    const std::array<double, 2> range = along == Parameter("nu")               ? std::array{0.05, 1.2}
                                        : along == Parameter("stop_amplitude") ? std::array{0.1, 4.0}
                                                                               : std::array{0.01, 2.0};
    const Branches found = follow_branches(problem, {.along = along, .range = range});
    for (const double value : special_values(found, SpecialKind::release_tangency, along)) {
      const FollowedScene there = changed(problem, along, value);
      const double press = constant_force(there.oscillator, 0.2);
      EXPECT_NEAR(std::abs(oscillator_in_frame(there).forcing), press, 1e-15) << along.key();
    }
    if (along == Parameter("load") || along == Parameter("stop_amplitude")) {
      EXPECT_EQ(special_values(found, SpecialKind::release_tangency, along).size(), 1) << along.key();
    }
  }
}

TEST(Shaken, stops_and_base_are_not_varied_at_once) {
  EXPECT_THROW(static_cast<void>(follow_branches(problem_of(1.0, 1.0, {.base = 0.1}),
                                                 {.along = Parameter("stop_amplitude"), .range = {0.0, 1.0}})),
               StartError);
}

}  // namespace
}  // namespace clatter::branches::shaking_test
