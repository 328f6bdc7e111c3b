// Branches of motion with a loose mass, against closed forms and runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "branches/branch.hpp"
#include "branches/equations/housing_multipliers.hpp"
#include "branches/equations/newton.hpp"
#include "branches/housing_motion.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/special_values.hpp"
#include "branches/start/start.hpp"
#include "branches/walk/violation.hpp"
#include "point/point.hpp"
#include "support/loose_scenes.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::housing_test {
namespace {

using std::numbers::pi;
using support::loose_scene;

/// A problem as [scene] gives it, with all that a branch's points are compared by.
sweep::GivenProblem given(const point::Problem& scene) {
  sweep::GivenProblem problem(scene);
  problem.observe.extrema = problem.observe.stability = problem.observe.period = problem.observe.impacts = true;
  problem.observe.loose_extrema = problem.observe.loose_stability = true;
  return problem;
}

/// That whose symmetric motion loses its stability in a Neimark-Sacker bifurcation at nu = 1.275.
point::Problem energy_sink(double nu) {
  point::Problem scene = loose_scene(0.05, 0.02, 0.3, nu, 1.9, 0.6);
  scene.loose.velocity = 0.5;
  return scene;
}
point::Problem impact_damper(double nu) { return loose_scene(0.02, 0.005, 0.01, nu, 0.4, 0.8); }

void expect_closed_form(const BranchPoint& point, std::size_t& compared) {
  if (!point.orbit.mirrored || point.orbit.size() != 1 || std::abs(point.orbit.events[0].before) < 1e-3) return;
  const HousingMotion known(point.scene);
  const OrbitEvent& impact = point.orbit.events[0];
  const double sign = sign_of(impact.side), u = sign * impact.before;
  if (known.discriminant < 1e-6 * known.alpha * known.alpha) return;  // beside the fold, where both are one
  const double off = std::min(std::abs(u - known.speed(1)), std::abs(u - known.speed(-1)));
  const double nu = point.scene.oscillator.frequency;
  EXPECT_LE(off, 1e-11 * u) << nu;
  EXPECT_NEAR(sign * impact.other.place, known.place(u), 1e-11) << nu;
  EXPECT_NEAR(sign * impact.other.before, known.velocity(u), 1e-11) << nu;
  ++compared;
}

TEST(Housing, has_symmetric_motion_of_the_closed_form_along_any_key) {
  struct Followed {
    Parameter key;
    double low, high;
  };
  const Followed followed[] = {{Parameter("nu"), 0.8, 1.2},       {Parameter("f"), 0.005, 0.05},
                               {Parameter("h"), 1e-3, 0.02},      {Parameter("loose_mass"), 0.01, 0.05},
                               {Parameter("loose_R"), 0.6, 0.9},  {Parameter("loose_gap"), 0.2, 0.6},
                               {Parameter("stiffness"), 0.9, 1.1}};
  for (const auto& [key, low, high] : followed) {
    const Branches found = follow_branches(given(impact_damper(1.0)), {.along = key, .range = {low, high}});
    std::size_t compared = 0;
    for (const BranchPoint& point : found.points) expect_closed_form(point, compared);
    EXPECT_GT(compared, 20) << key.key();
    for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << key.key() << ": " << end.reason;
  }
}

TEST(Housing, folds_where_both_motions_of_the_closed_form_become_one) {
  for (const point::Problem& scene : {impact_damper(1.0), energy_sink(1.2), loose_scene(0.1, 0.1, 0.6, 1.3, 1, 0.6)}) {
    const double f = scene.oscillator.forcing;
    const Branches found = follow_branches(given(scene), {.along = Parameter("f"), .range = {0.2 * f, 3 * f}});
    const HousingMotion known{FollowedScene(scene)};
    const double fold = f * known.fold() / known.amplitude;
    const std::vector<double> told = special_values(found, SpecialKind::fold, Parameter("f"));
    EXPECT_TRUE(std::ranges::any_of(told, [&](double at) { return std::abs(at - fold) <= 1e-11 * fold; })) << fold;
  }
}

/// Seven digits of the modulus and of the relative speed, computed apart from this program.
TEST(Housing, tells_where_a_pair_of_multipliers_leaves_the_unit_circle) {
  const Branches found = follow_branches(given(energy_sink(1.2)), {.along = Parameter("nu"), .range = {1.15, 1.3}});
  ASSERT_EQ(found.ends.size(), 2);
  const auto last =
      std::ranges::find(found.points, 1.3, [](const BranchPoint& p) { return p.scene.oscillator.frequency; });
  ASSERT_NE(last, found.points.end());
  EXPECT_NEAR(std::abs(last->orbit.events[0].before), 2.123117, 5e-7);
  EXPECT_NEAR(std::hypot(last->multiplier_re[0], last->multiplier_im[0]), 1.056775, 5e-7);
  const std::vector<double> told = special_values(found, SpecialKind::neimark_sacker, Parameter("nu"));
  ASSERT_EQ(told.size(), 1);
  for (const SpecialPoint& special : found.special) {
    if (special.kind != SpecialKind::neimark_sacker) continue;
    EXPECT_NEAR(std::hypot(special.at.multiplier_re[0], special.at.multiplier_im[0]), 1, 1e-10);
  }
  for (const double aside : {-5e-3, 5e-3}) {  // a run settles on this motion just on one side
    point::ThreadScratch scratch;
    const point::PointResult result = point::run_point(sweep::computed(given(energy_sink(told[0] + aside))), scratch);
    EXPECT_EQ(result.period_ratio == 1, aside < 0) << aside;
  }
}

/// The problem of a point of a branch, from its state on.
sweep::GivenProblem at_point(const sweep::GivenProblem& problem, Parameter along, const BranchPoint& point,
                             const Units& units) {
  sweep::GivenProblem there = problem;
  set(there, along, value_of(point.scene, along));
  const attractors::SectionState state = state_at_phase_zero(point.scene, point.orbit);
  const double of_velocity = factor_of(units, Quantity::velocity);
  there.start = {state.x, state.v * of_velocity, 0.0};
  there.loose.place = state.z, there.loose.velocity = state.w * of_velocity;
  return there;
}

/// At stable points of a branch a run finds the same motion. Its derivatives are those of the flow of states, and take
/// nothing from the equations of impacts.
void expect_runs(const sweep::GivenProblem& problem, Parameter along, std::array<double, 2> range) {
  const StartProblem start(problem);
  const Branches found = follow_branches(start, {.along = along, .range = range, .largest_step = 0.05});
  std::size_t compared = 0;
  for (const BranchPoint& point : found.points) {
    if (!point.stable || point.branch > 0) continue;
    const point::Problem there = sweep::computed(at_point(problem, along, point, start.units));
    point::ThreadScratch scratch;
    const point::PointResult run = run_point(there, scratch);
    const std::string where = std::string(along.key()) + " = " + std::to_string(value_of(point.scene, along));
    ASSERT_EQ(run.status, steady::Status::periodic) << where;
    const observables::Extrema::Values range_of = extrema(point.scene, point.orbit);
    EXPECT_NEAR(run.x_max, range_of.x_max, 1e-8 * range_of.x_max) << where;
    EXPECT_NEAR(run.y_max, range_of.y_max, 1e-8 * range_of.y_max) << where;
    EXPECT_NEAR(run.z_min, range_of.z_min, 1e-8 * std::abs(range_of.z_min)) << where;
    const double velocity = factor_of(there.units, Quantity::velocity) / factor_of(start.units, Quantity::velocity);
    EXPECT_NEAR(run.v_min * velocity, range_of.v_min, 1e-8 * std::abs(range_of.v_min)) << where;
    double product = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      product *= std::hypot(point.multiplier_re[i], point.multiplier_im[i]);
      EXPECT_NEAR(run.multiplier_re[i], point.multiplier_re[i], 1e-6) << where;
      EXPECT_NEAR(run.multiplier_im[i], point.multiplier_im[i], 1e-6) << where;
    }
    const double h = point.scene.oscillator.damping, nu = point.scene.oscillator.frequency,
                 impacts = static_cast<double>(point.orbit.whole().size());
    EXPECT_NEAR(product,
                std::exp(-4 * pi * h / nu * point.orbit.period_ratio()) *
                    std::pow(point.scene.loose.restitution_lower.R, 2 * impacts),
                1e-9)
        << where;
    ++compared;
  }
  EXPECT_GT(compared, 5) << along.key();
}

TEST(Housing, has_the_motion_and_multipliers_of_runs) {
  expect_runs(given(impact_damper(1.0)), Parameter("nu"), {0.98, 1.05});
  expect_runs(given(energy_sink(1.2)), Parameter("loose_R"), {0.4, 0.7});
  point::Problem one_wall = loose_scene(0.02, 0.1, 0.6, 1.3, 1, 0.2);
  one_wall.loose.lower = 0, one_wall.loose.place = 0.5;
  one_wall.loose.load = -0.6, one_wall.loose.upper = HUGE_VAL, one_wall.oscillator.load = 0.2;
  expect_runs(given(one_wall), Parameter("loose_load"), {-0.65, -0.55});
  point::Problem uneven = energy_sink(1.2);
  uneven.loose.lower = -1.2, uneven.oscillator.stiffness = 1.3;
  expect_runs(given(uneven), Parameter("loose_upper"), {1.5, 2.0});
}

/// On a shaken base they are relative to that; computed on the ground.
TEST(Housing, has_the_motion_of_runs_on_a_shaken_base) {
  point::Problem shaken = energy_sink(1.2);
  shaken.oscillator.forcing = 0.1, shaken.shaking = {.base = 0.3, .phase = 0.7};
  expect_runs(given(shaken), Parameter("base_amplitude"), {0.2, 0.4});
  expect_runs(given(shaken), Parameter("nu"), {1.15, 1.25});
}

TEST(Housing, has_the_motion_of_runs_of_a_machine_in_si) {
  const double m = 0.25, k = 800, rate = std::sqrt(k / m);
  const point::Problem scene = energy_sink(1.2);
  sweep::GivenProblem machine = given(scene);
  machine.is_si = true, machine.mass = m;
  machine.oscillator = {.forcing = 0.3 * k * 1e-3, .frequency = 1.2 * rate / (2 * pi), .stiffness = k};
  machine.damper = 2 * scene.oscillator.damping * m * rate;
  machine.loose = {
      .ratio = 0.05 * m, .lower = -1.9e-3, .upper = 1.9e-3, .restitution_lower = 0.6, .restitution_upper = 0.6};
  machine.loose.velocity = 0.5e-3 * rate;
  expect_runs(machine, Parameter("frequency"), {1.15 * rate / (2 * pi), 1.25 * rate / (2 * pi)});
  expect_runs(machine, Parameter("loose_mass"), {0.01, 0.02});
  expect_runs(machine, Parameter("mass"), {0.24, 0.26});
}

/// Residuals of unknowns that are changed a little, against the slopes that the equations tell.
void expect_slopes(const OrbitEquations& equations, const Vector& at) {
  const auto here = equations.at(at);
  ASSERT_TRUE(here);
  constexpr double step = 1e-6;
  for (std::size_t k = 0; k < at.size(); ++k) {
    Vector ahead = at, back = at;
    ahead[k] += step, back[k] -= step;
    const auto one = equations.at(ahead), other = equations.at(back);
    ASSERT_TRUE(one && other);
    for (std::size_t row = 0; row < here->residual.size(); ++row)
      EXPECT_NEAR(here->slope(row, k), (one->residual[row] - other->residual[row]) / (2 * step),
                  1e-7 * (1 + std::abs(here->slope(row, k))))
          << row << ' ' << k;
  }
}

TEST(Housing, has_equations_whose_slopes_are_limits_of_differences) {
  point::Problem scene = energy_sink(1.2);
  scene.oscillator.load = 0.1, scene.loose.load = -0.05, scene.shaking = {.base = 0.2, .phase = 0.4};
  const Orbit orbit{{{Side::lower, 0.4, -1.3, Event::Kind::strike, 0, 0, {0.3, 0.2}},
                     {Side::lower, 1.1, -0.4, Event::Kind::strike, 0, 0, {-0.2, 0.5}},
                     {Side::upper, 4.0, 1.7, Event::Kind::strike, 0, 0, {0.1, -0.3}}},
                    2,
                    false};
  for (const Parameter key :
       {Parameter("nu"), Parameter("h"), Parameter("f"), Parameter("load"), Parameter("stiffness"),
        Parameter("base_amplitude"), Parameter("stop_phase"), Parameter("loose_mass"), Parameter("loose_R"),
        Parameter("loose_load"), Parameter("loose_gap"), Parameter("loose_upper")}) {
    const OrbitEquations equations(scene, orbit, {{key, 0.7}}, 1.5, {{Condition::Kind::graze, 1, 2}});
    expect_slopes(equations, equations.unknowns_of(scene, orbit));
  }
}

/// Where the equation of a multiplier is 0 its slope has a corner, as it is the least singular value: no differences
/// there, but on the way.
TEST(Housing, has_an_equation_of_multipliers_whose_slopes_are_limits_of_differences) {
  const FollowedScene scene(static_cast<const Scene&>(energy_sink(1.2)));
  const Orbit half{{{Side::upper, 0.4, 1.3, Event::Kind::strike, 0, 0, {0.3, 0.2}}}, 1, true};
  Orbit three = half.whole();
  three.events.insert(three.events.begin() + 1, {Side::upper, 1.1, 0.4, Event::Kind::strike, 0, 0, {-0.2, 0.5}});
  for (const Orbit& orbit : {half, three})
    for (const int multiplier : {1, -1})
      for (const Parameter key : {Parameter("nu"), Parameter("stiffness"), Parameter("loose_mass")}) {
        const OrbitEquations equations(scene, orbit, {{key, 0.7}}, 1.5, {{Condition::Kind::multiplier, multiplier}});
        expect_slopes(equations, equations.unknowns_of(scene, orbit));
      }
}

/// The loss of symmetry is where a run's motion isn't its mirror image any more; at a flip its period doubles.
TEST(Housing, loses_symmetry_and_doubles_its_period_where_runs_do) {
  const Branches found = follow_branches(given(impact_damper(1.0)),
                                         {.along = Parameter("nu"), .range = {0.9965, 1.005}, .generations = 2});
  const std::vector<double> breaks = special_values(found, SpecialKind::symmetry_breaking, Parameter("nu")),
                            flips = special_values(found, SpecialKind::flip, Parameter("nu"));
  ASSERT_EQ(breaks.size(), 1);
  ASSERT_GE(flips.size(), 1);
  std::size_t asymmetric = 0, doubled = 0;
  for (const BranchPoint& point : found.points) {
    const double nu = point.scene.oscillator.frequency;
    const bool is_special = std::ranges::any_of(found.special, [&](const SpecialPoint& special) {
      return std::abs(special.at.scene.oscillator.frequency - nu) < 1e-9;
    });
    if (!point.stable || is_special) continue;
    point::ThreadScratch scratch;
    sweep::GivenProblem problem = given(impact_damper(1.0));
    problem.observe.word = true;
    const point::PointResult run =
        run_point(sweep::computed(at_point(problem, Parameter("nu"), point, Units{})), scratch);
    ASSERT_EQ(run.status, steady::Status::periodic) << nu;
    EXPECT_EQ(run.symmetric == 1, point.orbit.mirrored) << nu;
    EXPECT_EQ(run.period_ratio, point.orbit.period_ratio()) << nu;
    asymmetric += !point.orbit.mirrored, doubled += point.orbit.period_ratio() > 1;
  }
  EXPECT_GT(asymmetric, 5);
  EXPECT_GT(doubled, 5);
}

/// Both branches end in the graze: there the state of the motion is the same, and one has an impact without speed.
TEST(Housing, goes_on_beyond_a_graze_with_one_impact_more) {
  const Branches found =
      follow_branches(given(impact_damper(1.0)), {.along = Parameter("nu"), .range = {0.97, 1.005}, .generations = 1});
  std::size_t grazes = 0;
  for (const SpecialPoint& special : found.special) {
    if (special.kind != SpecialKind::graze || special.branches.size() < 2) continue;
    const auto slowest =
        std::ranges::min(special.at.orbit.events, {}, [](const OrbitEvent& impact) { return std::abs(impact.before); });
    EXPECT_NEAR(slowest.before, 0, 1e-12);
    std::vector<std::size_t> sizes;
    for (const std::size_t branch : special.branches)
      for (const BranchPoint& point : found.points)
        if (point.branch == branch) {
          sizes.push_back(point.orbit.size());
          break;
        }
    EXPECT_NE(std::ranges::min(sizes), std::ranges::max(sizes));
    ++grazes;
  }
  EXPECT_GE(grazes, 2);
}

void expect_refusal(const point::Problem& scene, const char* words) {
  try {
    (void)follow_branches(given(scene), {.along = Parameter("nu"), .range = {1.0, 1.5}});
    FAIL() << words;
  } catch (const StartError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Housing, refuses_motion_without_impacts_and_motion_that_a_wall_presses) {
  point::Problem scene = energy_sink(1.2);
  scene.loose.velocity = 0;
  expect_refusal(scene, "meets no wall");
  point::Problem pressed = loose_scene(0.5, 0.1, 0.4, 1.2, 1, 0.3);
  pressed.loose.load = -0.5, pressed.loose.lower = -0.1;
  expect_refusal(pressed, "presses the loose mass");
}

/// The amplitude at the forcing frequency, of which a maximum is sought, is that of a run; on a shaken base, too.
TEST(Housing, has_the_harmonic_and_the_power_of_runs) {
  point::Problem shaken = energy_sink(1.2);
  shaken.shaking = {.base = 0.3, .phase = 0.7};
  for (const point::Problem& scene : {energy_sink(1.2), shaken}) {
    sweep::GivenProblem problem = given(scene);
    problem.observe.energy = true, problem.observe.harmonics = 1;
    problem.observe.harmonics_method = observables::HarmonicsMethod::exact;
    const StartProblem start(problem);
    const Orbit orbit = start_orbit(start, 0, true);
    const OrbitEquations equations(start, orbit, {{Parameter("nu"), 1.0}}, 1.0);
    const Vector at = equations.unknowns_of(start, orbit), along(at.size(), 0.0);
    const Moving moving_there = moving(equations, at, along);
    point::ThreadScratch scratch;
    const point::PointResult run = run_point(sweep::computed(problem), scratch);
    EXPECT_NEAR(harmonic(moving_there).value, run.x_spectrum.amplitude[1], 1e-10);
    EXPECT_NEAR(impact_power(start, orbit),
                (run.loss_impact[0] + run.loss_impact[1]) / (2 * pi / 1.2 * run.period_ratio), 1e-10);
    EXPECT_NEAR(impact_power(moving_there).value, impact_power(start, orbit), 1e-12);
  }
}

}  // namespace
}  // namespace clatter::branches::housing_test
