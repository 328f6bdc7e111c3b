// Ends of branches of motion under dry friction: grazes, changes of halts, and where motion ceases.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "branches/branch.hpp"
#include "branches/measures/measures.hpp"

namespace clatter::branches::friction_ends_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The special points of branches along a parameter, of any kind but maxima, by their kinds and places.
std::vector<std::pair<std::string, double>> special_points(const Branches& found, Parameter along) {
  std::vector<std::pair<std::string, double>> points;
  for (const SpecialPoint& special : found.special)
    if (const std::string name(name_of(special.kind)); !name.starts_with("maximum"))
      points.emplace_back(name, value_of(special.at.scene, along));
  std::ranges::sort(points);
  return points;
}

/// No branch fails, and steps of any length find the same.
void expect_special_points(const sweep::GivenProblem& problem, Parameter along, std::array<double, 2> range,
                           std::vector<std::pair<std::string, double>> expected, std::int64_t generations = 0) {
  std::ranges::sort(expected);
  for (const double largest_step : {0.02, 0.011, 0.03}) {
    const Branches found = follow_branches(
        problem, {.along = along, .range = range, .largest_step = largest_step, .generations = generations});
    for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << end.reason;
    const auto points = special_points(found, along);
    ASSERT_EQ(points.size(), expected.size()) << largest_step;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i].first, expected[i].first);
      EXPECT_NEAR(points[i].second, expected[i].second, 1e-8) << points[i].first;
    }
  }
}

/// Between stops at +-gap with a restitution of 0.6.
sweep::GivenProblem symmetric_stops(double h, double nu, double gap, double mu) {
  sweep::GivenProblem problem;
  problem.oscillator = {h, 1.0, nu, 0.0, 1.0};
  problem.friction.kinetic = mu;
  problem.stops = {-gap, gap, 0.6, 0.6};
  return problem;
}

/// In a graze the velocity and the way to the stop fall to 0 at once, and rounding decides which is found first: of two
/// mirror images one was told, and all beyond the other was lost.
TEST(EndsUnderFriction, are_grazes_whatever_violation_is_found_first) {
  expect_special_points(symmetric_stops(0.01, 0.9, 1.2, 0.1), Parameter("load"), {-0.5, 0.5},
                        {{"fold", -0.10679195277},
                         {"fold", 0.10679195277},
                         {"graze", -0.05475498850},
                         {"graze", 0.05475498850},
                         {"grazing-sliding", -0.37334484187},
                         {"grazing-sliding", 0.37334484187},
                         {"switching-sliding", -0.38865813465},
                         {"switching-sliding", 0.38865813465},
                         {"crossing-sliding", -0.43378910176},
                         {"crossing-sliding", 0.43378910176}});
}

/// With a static level above the kinetic one a slip whose velocity just comes to 0 goes on by the kinetic level.
TEST(EndsUnderFriction, are_grazing_slidings_of_a_slip_that_goes_on) {
  sweep::GivenProblem problem = symmetric_stops(0.05, 0.6, 1.2, 0.3);
  problem.friction.static_level = 0.42;
  expect_special_points(problem, Parameter("load"), {-0.5, 0.5},
                        {{"grazing-sliding", -0.09597243}, {"grazing-sliding", 0.09597243}});
}

/// Motion that is its own mirror image, and doesn't reach the only stop, gains a stick in each half at once: each alone
/// may come earlier or later, and no step led off there. A mirror image of the stop changes nothing. Nor does the
/// motion that the branches begin with: short slips begin from nothing where they vanish on the way back, at the
/// switching- sliding on the way up, and at the release tangency, which is an early release, on the way down.
TEST(EndsUnderFriction, of_symmetric_motion_are_alike_with_one_stop_and_two_from_any_start) {
  sweep::GivenProblem problem = symmetric_stops(0.02, 0.3665, 9.0, 0.06);
  for (const double lower : {-infinity, -9.0})
    for (const double nu : {0.3665, 0.27, 0.323, 0.345}) {
      problem.stops = {lower, 9.0, lower == -infinity ? 1.0 : 0.6, 0.6};
      problem.oscillator.frequency = nu;
      expect_special_points(problem, Parameter("nu"), {0.26, 0.5},
                            {{"grazing-sliding", 0.362817539803},
                             {"switching-sliding", 0.326533670852},
                             {"release tangency", 0.320559909813},
                             {"grazing-sliding", 0.309261206419},
                             {"crossing-sliding", 0.307355708293}});
    }
}

/// Between stops, too: with two impacts and a stick on the way to each of them, begun on any of the branches.
TEST(EndsUnderFriction, are_those_of_the_branches_that_meet_there_from_any_of_them) {
  sweep::GivenProblem problem;
  problem.oscillator = {0.0, 1.0, 0.9416122576107108, 0.0, 1.0};
  problem.friction.kinetic = 0.049988928270946094;
  const double R = 0.6957346135498629, gap = 0.4638660160282706;
  problem.stops = {-gap, gap, R, R};
  for (const auto& [nu, x0] : {std::pair(0.9416, -0.205), std::pair(1.054, -0.2), std::pair(1.0595, -0.1)}) {
    problem.oscillator.frequency = nu, problem.start = {x0, 0.9};
    expect_special_points(
        problem, Parameter("nu"), {0.8, 1.0828},
        {{"crossing-sliding", 1.0478711395}, {"switching-sliding", 1.05781020994}, {"grazing-sliding", 1.06114629316}});
  }
}

/// The phase of a stick changes nothing later, but the motion that is born at a flip has it changed, too: without it
/// the first step led aside of the branch, which was lost.
TEST(EndsUnderFriction, of_motion_that_is_born_with_a_stick_are_found) {
  sweep::GivenProblem problem;
  problem.oscillator = {0.0, 1.0, 1.28, 0.0, 1.0};
  problem.friction.kinetic = 0.2325;
  problem.stops = {-0.2035, 0.2757, 0.45, 0.45};
  problem.start = {0.07, 0.13};
  expect_special_points(
      problem, Parameter("nu"), {1.23, 1.3},
      {{"flip", 1.25281657328}, {"flip", 1.25959683669}, {"graze", 1.25161828282}, {"graze", 1.25970507593}}, 1);
}

/// A mass that has come to a stop without speed is held there by the static level: nothing begins there.
TEST(EndsUnderFriction, are_grazes_at_which_motion_jumps) {
  sweep::GivenProblem problem;
  problem.oscillator = {0.0015, 1.0, 0.9, 0.0, 1.0};
  problem.friction.kinetic = 0.247, problem.friction.static_level = 0.27;
  problem.stops = {-0.35, 0.41, 0.51, 0.51};
  problem.start = {0.03, 0.35};
  const Branches found = follow_branches(problem, {.along = Parameter("f"), .range = {0.9, 1.1}});
  for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << end.reason;
  const auto points = special_points(found, Parameter("f"));
  const auto is_jump = [](const auto& point) {
    return point.first == "graze" && std::abs(point.second - 0.98517524612) < 1e-9;
  };
  EXPECT_TRUE(std::ranges::any_of(points, is_jump));
}

/// Where a slip to a stick comes to a stop, the mass would strike that, and leave it by the kinetic level.
TEST(EndsUnderFriction, are_grazes_after_which_a_mass_slips_on) {
  sweep::GivenProblem problem;
  problem.oscillator = {0.0011552155673588776, 1.0, 0.7147072258264515, 0.08969054290496936, 1.2878062318197334};
  problem.friction.kinetic = 0.24754244269282435, problem.friction.static_level = 0.32648270068323093;
  problem.stops = {-0.44215337746527456, 0.44215337746527456, 0.7817292725359447, 0.7817292725359447};
  problem.start = {-0.013555009021215697, -0.150778417835693};
  expect_special_points(problem, Parameter("load"), {-0.21, 0.389},
                        {{"graze", 0.03369423537}, {"grazing-sliding", 0.12340120798}});
}

/// Beside an end at which derivatives have no digits steps of any length lead to it.
TEST(EndsUnderFriction, are_found_from_afar) {
  sweep::GivenProblem problem;
  problem.oscillator = {0.0, 1.0, 0.39420449773276955, 0.09, 1.0};
  problem.friction.kinetic = 0.4573;
  problem.stops = {-infinity, 10.0, 1.0, 0.6};
  const std::array range{0.13719205024991102, 0.8231522814220623};
  for (const double largest_step : {0.007, 0.02}) {
    const Branches found =
        follow_branches(problem, {.along = Parameter("friction"), .range = range, .largest_step = largest_step});
    const auto points = special_points(found, Parameter("friction"));
    ASSERT_EQ(points.size(), 1u) << largest_step;
    EXPECT_EQ(points[0].first, "switching-sliding");
    EXPECT_NEAR(points[0].second, 0.17391931987, 1e-10);
  }
}

TEST(EndsUnderFriction, are_where_friction_is_up_to_the_force) {
  sweep::GivenProblem problem = symmetric_stops(0.2776, 1.024, 1.769, 0.053);
  for (const double load : {0.0, 0.1}) {  // at rest beside the middle, with a stick on either side of that
    problem.oscillator.load = load;
    for (const auto& [parameter, range] : {std::pair(Parameter("friction"), std::array{0.0159, 1.2}),
                                           std::pair(Parameter("f"), std::array{0.04, 1.5})}) {
      const Branches found = follow_branches(problem, {.along = parameter, .range = range});
      for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << end.reason;
      const auto ceases = std::ranges::find(found.special, SpecialKind::motion_ceases, &SpecialPoint::kind);
      ASSERT_NE(ceases, found.special.end());
      EXPECT_NEAR(ceases->at.scene.friction.kinetic, ceases->at.scene.oscillator.forcing, 1e-15);
      const PhasePoint state = state_at_phase_zero(ceases->at.scene, ceases->at.orbit);
      EXPECT_NEAR(state.x, load, 1e-15);
      EXPECT_EQ(state.v, 0);
      const auto range_of_x = extrema(ceases->at.scene, ceases->at.orbit);
      EXPECT_NEAR(range_of_x.x_min, load, 1e-15);
      EXPECT_NEAR(range_of_x.x_max, load, 1e-15);
      const auto hardly_move = std::ranges::count_if(
          found.points, [](const BranchPoint& point) { return extrema(point.scene, point.orbit).v_max < 1e-9; });
      EXPECT_LE(hardly_move, 3);
    }
  }
}

/// With a static level above the kinetic one slips are as long as ever where their release vanishes: at the crest of
/// the force, which is there as strong as the level less the spring's pull. A stop out of reach changes nothing.
TEST(EndsUnderFriction, are_releases_at_the_crest_of_the_force) {
  sweep::GivenProblem problem = symmetric_stops(0.0366, 0.852, 1.346, 0.337);
  problem.friction.static_level = 0.3554;
  problem.oscillator.forcing = 0.5;
  for (const double lower : {-1.346, -infinity}) {
    problem.stops.lower = lower;
    const Branches found = follow_branches(problem, {.along = Parameter("f"), .range = {0.1, 0.52}});
    for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << end.reason;
    const auto crest = std::ranges::find(found.special, SpecialKind::release_tangency, &SpecialPoint::kind);
    ASSERT_NE(crest, found.special.end());
    for (const OrbitEvent& stick : crest->at.orbit.events)
      EXPECT_NEAR(crest->at.scene.oscillator.forcing, 0.3554 - std::abs(stick.place), 1e-13);
    EXPECT_NEAR(crest->at.scene.oscillator.forcing, 0.35447744, 1e-8);
  }
}

/// The motion of three periods comes to that of one, all of whose slips begin to stick: it is told as the change of
/// that, which is exact.
TEST(EndsUnderFriction, are_those_of_motion_that_repeats_sooner) {
  sweep::GivenProblem problem = symmetric_stops(0.0269, 0.365, 1.016, 0.031);
  problem.stops.restitution_lower = problem.stops.restitution_upper = 0.315;
  const Branches found = follow_branches(problem, {.along = Parameter("load"), .range = {-0.5, 0.5}});
  for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << end.reason;
}

/// Plain scenes, drawn: no end is unexplained, and steps of any length find the same special points.
TEST(EndsUnderFriction, are_explained_in_plain_scenes) {
  std::mt19937 random(64);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  int followed = 0;
  for (int i = 0; i < 40; ++i) {
    sweep::GivenProblem problem = symmetric_stops(draw(0.01, 0.2), draw(0.4, 1.8), draw(0.4, 2), draw(0.05, 0.6));
    if (i % 3 == 2) problem.friction.static_level = problem.friction.kinetic * draw(1.05, 1.4);
    const bool by_load = i % 2 == 0;
    const Parameter along = by_load ? Parameter("load") : Parameter("f");
    BranchSettings settings{.along = along, .range = by_load ? std::array{-0.5, 0.5} : std::array{0.1, 2.0}};
    try {
      const Branches found = follow_branches(problem, settings);
      settings.largest_step = 0.013;
      const auto points = special_points(found, along),
                 others = special_points(follow_branches(problem, settings), along);
      ++followed;
      for (const BranchEnd& end : found.ends) EXPECT_NE(end.reason, no_halt_change) << i;
      ASSERT_EQ(points.size(), others.size()) << i;
      for (std::size_t k = 0; k < points.size(); ++k) EXPECT_NEAR(points[k].second, others[k].second, 1e-7) << i;
    } catch (const StartError&) {
    }
  }
  EXPECT_GT(followed, 20);
}

}  // namespace
}  // namespace clatter::branches::friction_ends_test
