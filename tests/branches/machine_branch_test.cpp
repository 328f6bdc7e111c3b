#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "branches/branch.hpp"
#include "branches/measures/measures.hpp"
#include "point/point.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::machine_branch_test {
namespace {

/// A machine between rigid or soft stops.
sweep::GivenProblem machine(bool soft) {
  sweep::GivenProblem problem;
  problem.is_si = true, problem.mass = 0.5;
  problem.oscillator = {0, 25.6, 28.0, 0, 12.8e3};  // natural frequency 25.5 Hz
  problem.stops = {-2e-3, 2e-3, 0.7, 0.7};
  if (soft) problem.stops.stiffness_lower = problem.stops.stiffness_upper = 4e5;
  return problem;
}

struct Along {
  const char* what;
  Parameter along;
  std::array<double, 2> range;
  bool soft = false;
  double damper = 0, ratio = 0, quality = HUGE_VAL, stop_damper = 0, stop_ratio = 0;
};

/// At the parameter of a point `clatter run` finds its motion from its start, in units of its own: whatever key is
/// followed, beside whatever other that its numbers are made of.
void expect_runs(const Along& of) {
  sweep::GivenProblem given = machine(of.soft);
  given.damper = of.damper, given.damping_ratio = of.ratio, given.quality = of.quality;
  given.stop_damper_lower = given.stop_damper_upper = of.stop_damper;
  given.stops.damping_lower = given.stops.damping_upper = of.stop_ratio;
  const StartProblem start(given);
  const Branches found = follow_branches(start, {.along = of.along, .range = of.range, .largest_step = 0.05});
  std::size_t compared = 0;
  for (const BranchPoint& point : found.points) {
    if (!point.stable || point.branch > 0) continue;
    const PhasePoint state = state_at_phase_zero(point.scene, point.orbit);
    sweep::GivenProblem at = given;
    if (of.along.role() == Role::damping) at.damper = at.damping_ratio = 0, at.quality = HUGE_VAL;
    if (of.along.role() == Role::stop_damping)
      at.stop_damper_lower = at.stop_damper_upper = at.stops.damping_lower = at.stops.damping_upper = 0;
    set(at, of.along, value_of(point.scene, of.along));
    at.start = {state.x, state.v * factor_of(start.units, Quantity::velocity), 0.0};
    at.observe.extrema = at.observe.impacts = true;
    const point::Problem problem = sweep::computed(at);
    point::ThreadScratch scratch;
    const point::PointResult run = run_point(problem, scratch);
    ASSERT_EQ(run.status, steady::Status::periodic) << of.what;
    const observables::Extrema::Values range = extrema(point.scene, point.orbit);
    EXPECT_NEAR(run.x_max, range.x_max, 1e-9 * range.x_max) << of.what << ' ' << value_of(point.scene, of.along);
    EXPECT_NEAR(run.v_max * factor_of(problem.units, Quantity::velocity),
                range.v_max * factor_of(start.units, Quantity::velocity),
                1e-8 * range.v_max * factor_of(start.units, Quantity::velocity))
        << of.what;
    ++compared;
  }
  EXPECT_GT(compared, 5) << of.what;
}

TEST(MachineBranch, is_followed_along_any_key_beside_any_other) {
  const Parameter stop_damper = *Parameter::of("stop_damping", Quantity::damping);
  for (const Along& of :
       {Along{"mass beside a ratio", "mass", {0.45, 0.6}, false, 0, 0.05},
        {"mass beside a coefficient", "mass", {0.45, 0.6}, false, 8},
        {"mass beside a quality", "mass", {0.45, 0.6}, false, 0, 0, 10},
        {"stiffness beside a ratio", "stiffness", {12e3, 14e3}, false, 0, 0.05},
        {"quality", "quality", {8, 12}, false, 0, 0, 10},
        {"damping beside a quality", "damping", {6, 10}, false, 0, 0, 10},
        {"a ratio beside a coefficient", "damping_ratio", {0.04, 0.06}, false, 8},
        {"frequency", "frequency", {27, 30}, false, 0, 0.05},
        {"force", "force", {24, 30}, false, 0, 0.05},
        {"gap", "gap", {1.7e-3, 2.1e-3}, false, 0, 0.05},
        {"mass beside a stop's damper", "mass", {0.48, 0.55}, true, 0, 0.05, HUGE_VAL, 40},
        {"a stop's damper", stop_damper, {30, 60}, true, 0, 0.05, HUGE_VAL, 40},
        {"a stop's stiffness beside its damper", "stop_stiffness", {3e5, 5e5}, true, 0, 0.05, HUGE_VAL, 40},
        {"a stop's damping ratio", "stop_damping", {0.02, 0.1}, true, 0, 0.05, HUGE_VAL, 0, 0.05},
        {"a stop's restitution beside its ratio", "stop_R", {0.8, 0.95}, true, 0, 0.05, HUGE_VAL, 0, 0.05},
        {"a stop's restitution beside its damper", "stop_R", {0.8, 0.95}, true, 0, 0.05, HUGE_VAL, 40}}) {
    expect_runs(of);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(MachineBranch, begins_at_a_finite_value) {
  try {
    (void)follow_branches(machine(false), {.along = "quality", .range = {8, 12}});
    FAIL() << "a quality of an undamped machine";
  } catch (const StartError& error) {
    EXPECT_STREQ(error.what(), "branch.along = quality has no finite value at the start; give machine.quality");
  }
}

}  // namespace
}  // namespace clatter::branches::machine_branch_test
