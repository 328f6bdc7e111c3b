// Branches of motion under dry friction, against closed forms and runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "attractors/periodic_motion.hpp"
#include "branches/branch.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"

namespace clatter::branches::friction_test {
namespace {

using std::numbers::pi;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An oscillator without stops.
sweep::GivenProblem rubbing(double h, double nu, double mu) {
  sweep::GivenProblem problem;
  problem.oscillator = {h, 1.0, nu, 0.0, 1.0};
  problem.stops = {-infinity, infinity, 1.0, 1.0};
  problem.friction.kinetic = mu;
  return problem;
}

/// Between stops at +-0.5.
sweep::GivenProblem between_stops(double nu, double mu) {
  sweep::GivenProblem problem = rubbing(0.05, nu, mu);
  problem.stops = {-0.5, 0.5, 0.7, 0.7};
  return problem;
}

/// Between soft ones, of which the upper one has a damper; friction holds the mass by more than it brakes it.
sweep::GivenProblem between_soft_stops(double nu, double mu) {
  sweep::GivenProblem problem = between_stops(nu, mu);
  problem.stops.stiffness_lower = 20, problem.stops.stiffness_upper = 10, problem.stops.damping_upper = 0.2;
  problem.friction.static_level = 1.2 * mu;
  return problem;
}

/// Amplitude of motion without stick, damper and stops (Den Hartog 1931).
double amplitude(double nu, double mu) {
  const double V = 1 / (1 - nu * nu), U = std::sin(pi / nu) / (nu * (1 + std::cos(pi / nu)));
  return std::sqrt(V * V - mu * mu * U * U);
}

double highest(const BranchPoint& point) { return extrema(point.scene, point.orbit).x_max; }

TEST(Rubbing, has_the_amplitude_of_Den_Hartog_along_the_frequency) {
  EXPECT_NEAR(amplitude(0.8, 0.3), 2.62610487572348, 1e-13);
  for (const auto& [nu, mu, low, high] : {std::array{0.8, 0.3, 0.75, 0.95}, {1.3, 0.2, 1.1, 1.4}}) {
    const Branches found = follow_branches(rubbing(0.0, nu, mu), {.along = Parameter("nu"), .range = {low, high}});
    ASSERT_GT(found.points.size(), 20);
    for (const BranchPoint& point : found.points) {
      const double expected = amplitude(point.scene.oscillator.frequency, mu);
      EXPECT_NEAR(highest(point), expected, 1e-12 * expected) << point.scene.oscillator.frequency;
      EXPECT_TRUE(point.orbit.mirrored);
    }
    for (const BranchEnd& end : found.ends) EXPECT_EQ(end.reason, "range");
  }
}

TEST(Rubbing, has_the_amplitude_of_Den_Hartog_down_to_no_friction) {
  const Branches found = follow_branches(rubbing(0.0, 0.8, 0.3), {.along = Parameter("friction"), .range = {0.0, 0.4}});
  for (const BranchPoint& point : found.points)
    EXPECT_NEAR(highest(point), amplitude(0.8, point.scene.friction.kinetic), 1e-12);
  EXPECT_EQ(found.points.front().scene.friction.kinetic, 0);
  EXPECT_NEAR(highest(found.points.front()), 1 / 0.36, 1e-12);
}

/// A halt comes to the position of a soft stop: beyond, the mass halts within it.
TEST(Rubbing, comes_to_a_soft_stop_with_the_amplitude_of_Den_Hartog) {
  sweep::GivenProblem problem = rubbing(0.0, 0.8, 0.3);
  const double gap = amplitude(0.82, 0.3);
  problem.stops.lower = -gap, problem.stops.upper = gap;
  problem.stops.stiffness_lower = problem.stops.stiffness_upper = 10;
  const Branches found = follow_branches(problem, {.along = Parameter("nu"), .range = {0.78, 0.86}});
  const auto graze = std::ranges::find(found.special, SpecialKind::graze, &SpecialPoint::kind);
  ASSERT_NE(graze, found.special.end());
  EXPECT_NEAR(graze->at.scene.oscillator.frequency, 0.82, 1e-12);
  EXPECT_EQ(graze->branches, (std::vector<std::size_t>{0, 1}));
  for (const BranchPoint& point : found.points) EXPECT_EQ(highest(point) > gap + 1e-12, point.branch == 1);
  EXPECT_EQ(std::ranges::count(found.ends, true, &BranchEnd::failed), 0);
}

void expect_multipliers_of_runs(sweep::GivenProblem given) {
  const double nu = given.oscillator.frequency;
  const Branches found = follow_branches(given, {.along = Parameter("nu"), .range = {nu - 0.05, nu + 0.05}});
  ASSERT_GT(found.points.size(), 5);
  for (const BranchPoint& point : found.points) {
    const bool is_special = std::ranges::any_of(found.special, [&](const SpecialPoint& special) {
      return std::abs(special.at.scene.oscillator.frequency - point.scene.oscillator.frequency) < 1e-4;
    });
    if (is_special || point.orbit.period_ratio() != 1) continue;  // derivatives jump there
    given.oscillator.frequency = point.scene.oscillator.frequency;
    const point::Problem problem = sweep::computed(given);
    const PhasePoint state = state_at_phase_zero(point.scene, point.orbit);
    constexpr double change = 1e-5;
    if (std::abs(state.v) < 2 * change) continue;  // slower ones would stick
    const auto end = [&](double dx, double dv) {
      return attractors::state_after(attractors::started(problem, {state.x + dx, state.v + dv}, 0.0), 1.0).value();
    };
    const auto slope = [&](double dx, double dv) {
      const PhasePoint ahead = end(dx * change, dv * change), behind = end(-dx * change, -dv * change);
      return std::array{(ahead.x - behind.x) / (2 * change), (ahead.v - behind.v) / (2 * change)};
    };
    const auto [xx, vx] = slope(1, 0);
    const auto [xv, vv] = slope(0, 1);
    const auto& [re, im] = std::tie(point.multiplier_re, point.multiplier_im);
    EXPECT_NEAR(re[0] + re[1], xx + vv, 1e-8);
    EXPECT_NEAR(re[0] * re[1] - im[0] * im[1], xx * vv - xv * vx, 1e-8);  // the differences' error is change^2
  }
}

TEST(Rubbing, has_the_multipliers_of_runs) {
  expect_multipliers_of_runs(rubbing(0.05, 0.8, 0.3));
  for (const double nu : {0.8, 1.3}) expect_multipliers_of_runs(between_soft_stops(nu, 0.1));
}

TEST(Rubbing, multiplies_areas_by_the_accelerations_at_reversals) {
  const Branches found = follow_branches(rubbing(0.05, 0.8, 0.3), {.along = Parameter("nu"), .range = {0.8, 0.81}});
  const BranchPoint& point = found.points.front();
  const auto& [re, im] = std::tie(point.multiplier_re, point.multiplier_im);
  EXPECT_NEAR(re[0] * re[1] - im[0] * im[1], 0.20139584, 5e-9);
}

TEST(Sticking, keeps_the_place_alone) {
  const Branches found = follow_branches(between_stops(1.3, 0.2), {.along = Parameter("nu"), .range = {1.3, 1.31}});
  const BranchPoint& point = found.points.front();
  ASSERT_EQ(point.orbit.size(), 3);
  EXPECT_NEAR(point.multiplier_re[0], 0.267959696315445, 1e-13);
  EXPECT_EQ(point.multiplier_re[1], 0);
  EXPECT_NEAR(point.orbit.events[0].before, 0.940532086164330, 1e-14);
  EXPECT_NEAR(point.orbit.events[1].before, -0.718708034646616, 1e-14);
  EXPECT_EQ(point.orbit.events[2].kind, Event::Kind::stick);
  EXPECT_NEAR(point.orbit.events[2].place, -0.327636229491487, 1e-14);
}

/// A slip of no length solves its equations at any speed, and in a graze rounding decides if the mass halts before it.
TEST(Sticking, goes_on_past_the_graze_at_which_a_slip_vanishes) {
  sweep::GivenProblem problem = rubbing(0.0, 1.0685085638604543, 0.20797057710696987);
  problem.oscillator.stiffness = 1.670823332204417, problem.oscillator.load = 0.29064189875931284;
  problem.stops = {-0.28661948695205147, 0.28661948695205147, 0.7697597716164745, 0.7697597716164745};
  problem.start = {-0.14291807588504682, 0.09749924090526019, 0.0};
  for (const std::array range : {std::array{0.98, 1.08}, {0.97, 1.1}, {0.74, 1.5}}) {
    const Branches found = follow_branches(problem, {.along = Parameter("nu"), .range = range});
    EXPECT_EQ(std::ranges::count(found.ends, true, &BranchEnd::failed), 0) << range[0];
    EXPECT_TRUE(std::ranges::any_of(found.special, [](const SpecialPoint& special) {
      return special.kind == SpecialKind::graze &&
             std::abs(special.at.scene.oscillator.frequency - 1.00375011065766) <= 1e-12;
    })) << range[0];
    const double lowest = std::ranges::min(found.points, {}, [](const BranchPoint& point) {
                            return point.scene.oscillator.frequency;
                          }).scene.oscillator.frequency;
    EXPECT_LT(lowest, 0.99);
  }
}

/// Impacts in a forcing period of the motion that a scene settles on.
std::size_t impacts_in_a_period(sweep::GivenProblem given, double nu) {
  given.oscillator.frequency = nu;
  const point::Problem problem = sweep::computed(given);
  const PhasePoint settled = attractors::state_after(problem, 200.0).value();
  return attractors::run_round(attractors::started(problem, settled, 0.0), 1).value().contacts.size();
}

/// A slip that ends in a stick comes as far as a stop: beyond, the mass strikes that, and sticks after a short rebound.
TEST(Sticking, strikes_a_stop_that_its_slip_just_reaches) {
  sweep::GivenProblem between = rubbing(0.0, 0.7537917420175924, 0.5447071533167794), above = between;
  between.stops = {-0.3623123571635895, 0.3623123571635895, 0.3551697435651783, 0.3551697435651783};
  between.start = {0.3023816290121704, 0.34431652018089265, 0.0};
  above = rubbing(0.0, 0.7819195336535755, 0.41556263870910115);
  above.oscillator.load = 0.013276054222406353;
  above.stops = {-infinity, 0.2792844393465209, 1.0, 0.42884250168374793};
  above.start = {-0.2518768554211011, -0.30018339221726653, 0.0};
  for (const auto& [problem, low, more] : {std::tuple{between, 0.6, 2U}, {above, 0.725, 1U}}) {
    const BranchSettings settings{.along = Parameter("nu"), .range = {low, 0.783}};
    const Branches found = follow_branches(problem, settings);
    EXPECT_EQ(std::ranges::count(found.ends, true, &BranchEnd::failed), 0);
    const auto graze = std::ranges::find(found.special, SpecialKind::graze, &SpecialPoint::kind);
    ASSERT_NE(graze, found.special.end());
    EXPECT_EQ(graze->branches[1], 1);
    const double at = graze->at.scene.oscillator.frequency;
    EXPECT_EQ(impacts_in_a_period(problem, at - 1e-3), impacts_in_a_period(problem, at + 1e-3) + more);
    const double stop = problem.stops.upper, middle = numbers_of<double>(graze->at.scene).middle();
    const auto stick = std::ranges::find_if(graze->at.orbit.events, [&](const OrbitEvent& event) {
      return event.kind == Event::Kind::stick && std::abs(std::abs(event.place + middle) - stop) < 1e-12;
    });
    EXPECT_NE(stick, graze->at.orbit.events.end());
    for (std::size_t i = 1; i < found.points.size(); ++i) {
      if (found.points[i].branch != found.points[i - 1].branch) continue;
      const double step = found.points[i].scene.oscillator.frequency - found.points[i - 1].scene.oscillator.frequency;
      EXPECT_LE(std::abs(step), 1.05 * settings.largest_step * (0.783 - low));
    }
  }
}

/// Equations of a motion of a branch, in which the frequency varies.
OrbitEquations along_frequency(const BranchPoint& point, std::vector<Condition> conditions = {}) {
  return {point.scene, point.orbit, {{Parameter("nu"), 1.0}}, 1.0, std::move(conditions)};
}

TEST(Sticking, has_the_derivatives_of_its_equations) {
  constexpr double change = 1e-6;
  for (const sweep::GivenProblem& problem :
       {rubbing(0.05, 0.8, 0.3), between_stops(1.3, 0.2), between_soft_stops(0.8, 0.2)}) {
    const double nu = problem.oscillator.frequency;
    const BranchPoint point =
        follow_branches(problem, {.along = Parameter("nu"), .range = {nu, nu + 0.01}}).points.front();
    for (const Condition& condition :
         {Condition{.kind = Condition::Kind::multiplier, .multiplier = -1, .without = {}},
          Condition{
              .kind = Condition::Kind::level, .event = point.orbit.size() - 1, .without = {}, .side = Side::upper}}) {
      const OrbitEquations equations = along_frequency(point, {condition});
      const Vector at = equations.unknowns_of(point.scene, point.orbit);
      const auto here = equations.at(at).value();
      for (std::size_t j = 0; j < equations.unknowns(); ++j) {
        Vector ahead = at, behind = at;
        ahead[j] += change, behind[j] -= change;
        const Vector high = equations.at(ahead).value().residual, low = equations.at(behind).value().residual;
        for (std::size_t i = 0; i < equations.equations(); ++i)
          EXPECT_NEAR(here.slope(i, j), (high[i] - low[i]) / (2 * change), 1e-8) << i << ' ' << j << " nu = " << nu;
      }
    }
  }
}

TEST(Sticking, has_the_harmonic_of_its_motion) {
  for (const sweep::GivenProblem& problem :
       {rubbing(0.05, 0.8, 0.3), between_stops(1.3, 0.2), between_soft_stops(0.8, 0.2)}) {
    const double nu = problem.oscillator.frequency;
    const BranchPoint point =
        follow_branches(problem, {.along = Parameter("nu"), .range = {nu, nu + 0.01}}).points.front();
    const OrbitEquations equations = along_frequency(point);
    const Vector at = equations.unknowns_of(point.scene, point.orbit), still(equations.unknowns(), 0.0);
    const PhasePoint start = state_at_phase_zero(point.scene, point.orbit);
    constexpr int samples = 2000;  // the kinks of x leave 1/samples^2
    double re = 0, im = 0;
    for (int i = 0; i < samples; ++i) {
      const double turn = static_cast<double>(i) / samples;
      const PhasePoint state =
          i == 0 ? start
                 : attractors::state_after(attractors::started(sweep::computed(problem), start, 0.0), turn).value();
      re += state.x * std::cos(2 * pi * turn) / samples, im -= state.x * std::sin(2 * pi * turn) / samples;
    }
    EXPECT_NEAR(harmonic(moving(equations, at, still)).value, 2 * std::hypot(re, im), 1e-6) << nu;
  }
}

TEST(Branches, refuse_what_friction_makes_of_a_start) {
  const auto why = [](const sweep::GivenProblem& problem, Parameter along, std::array<double, 2> range) {
    try {
      static_cast<void>(follow_branches(problem, {.along = along, .range = range}));
    } catch (const StartError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(why(between_stops(1.3, 1.5), Parameter("nu"), {1.2, 1.4}).find("for good"), std::string::npos);
  EXPECT_NE(why(rubbing(0.05, 1.3, 0.0), Parameter("friction"), {0.0, 0.4}).find("no dry friction"), std::string::npos);
  sweep::GivenProblem rests = between_stops(0.3, 0.1);
  rests.stops = {-infinity, 0.2, 0.3, 0.3};
  EXPECT_NE(why(rests, Parameter("nu"), {0.2, 0.4}).find("rests on a stop"), std::string::npos);
  sweep::GivenProblem level = between_stops(1.3, 0.2);
  level.friction.static_level = 0.25;
  EXPECT_NE(why(level, Parameter("friction"), {0.1, 0.3}).find("reaches friction_static"), std::string::npos);
  EXPECT_NE(why(level, Parameter("friction_static"), {0.1, 0.3}).find("below friction"), std::string::npos);
}

}  // namespace
}  // namespace clatter::branches::friction_test
