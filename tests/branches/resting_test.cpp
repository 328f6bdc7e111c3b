#include "branches/start/resting.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "branches/branch.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/special_values.hpp"
#include "branches/symmetric_motion.hpp"
#include "point/point.hpp"

namespace clatter::branches::resting_test {
namespace {

/// Rests on both stops in every period below nu = 0.4666; above it the chatters don't end before the release.
point::Problem two_stops(double nu) {
  point::Problem problem;
  problem.oscillator = {0.1, 1.0, nu, 0.0};
  problem.stops = {-0.4, 0.4, 0.6, 0.6};
  problem.start = {0.0, 1.0, 0.0};
  problem.observe.energy = true;
  return problem;
}

/// One stop, on which a load presses the mass more or less.
point::Problem loaded(double load) {
  point::Problem problem;
  problem.oscillator = {0.05, 1.0, 0.4, load};
  problem.stops.upper = 0.2, problem.stops.restitution_upper = 0.5;
  problem.start = {0.0, 1.0, 0.0};
  return problem;
}

TEST(RestingOrbit, is_the_motion_of_a_run) {
  point::Problem problem = two_stops(0.3);
  problem.observe.extrema = true, problem.observe.word = true, problem.observe.attractor = true;
  point::ThreadScratch scratch;
  const point::PointResult run = run_point(problem, scratch);
  for (const Side stop : {Side::lower, Side::upper}) {
    const auto orbit = resting_orbit(problem, stop, 1);
    ASSERT_TRUE(orbit);
    EXPECT_EQ(orbit->word(), run.impact_word);
    EXPECT_NEAR(impact_power(problem, *orbit), run.impact_power, 1e-12);
    const observables::Extrema::Values range = extrema(problem, *orbit);
    EXPECT_NEAR(range.v_max, run.v_max, 1e-12);
    EXPECT_NEAR(range.x_min, run.x_min, 1e-15);
    const PhasePoint state = state_at_phase_zero(problem, *orbit);
    EXPECT_NEAR(state.x, run.attractor_x, 1e-12);
    EXPECT_NEAR(state.v, run.attractor_v, 1e-12);
    EXPECT_TRUE(multipliers(problem, *orbit).stable);
    EXPECT_TRUE(orbit->half_if_same(1e-6, true).mirrored);
  }
}

TEST(RestingOrbit, is_none_where_the_motion_does_not_come_back_to_rest) {
  EXPECT_FALSE(resting_orbit(two_stops(0.6), Side::upper, 1));
  EXPECT_FALSE(resting_orbit(loaded(1.3), Side::upper, 1));  // pressed all the time
}

TEST(RestingOrbit, is_released_where_the_pressing_force_falls_to_zero) {
  for (const double load : {-0.5, 0.0, 0.7}) {
    const point::Problem problem = loaded(load);
    const double phase = release_phase(problem, Side::upper).value();
    EXPECT_NEAR(std::sin(phase) + load, 0.2, 1e-15);
    EXPECT_LT(std::cos(phase), 0);
  }
  EXPECT_FALSE(release_phase(loaded(1.3), Side::upper));
}

TEST(MovingFromRelease, has_the_derivatives_of_differences) {
  for (const Parameter along :
       {Parameter("h"), Parameter("f"), Parameter("nu"), Parameter("R"), Parameter("load"), Parameter("xs")}) {
    point::Problem problem = two_stops(0.3);
    problem.oscillator.load = 0.03;  // one impact is the fastest
    const auto at = [&](double change) {
      point::Problem other = problem;
      static_cast<Scene&>(other) = changed(problem, along, value_of(problem, along) + change);
      return std::pair(other, resting_orbit(other, Side::upper, 1).value());
    };
    const auto [scene, orbit] = at(0.0);
    const auto [scene_ahead, ahead] = at(1e-6);
    const auto [scene_behind, behind] = at(-1e-6);
    const Moving m = moving_from_release(scene, orbit, along);
    const double speed = (impact_speed(ahead) - impact_speed(behind)) / 2e-6;
    const double power = (impact_power(scene_ahead, ahead) - impact_power(scene_behind, behind)) / 2e-6;
    const auto name = along.key();
    EXPECT_NEAR(impact_speed(m).value, impact_speed(orbit), 1e-15) << name;
    EXPECT_NEAR(impact_power(m).value, impact_power(scene, orbit), 1e-14) << name;
    EXPECT_NEAR(impact_speed(m).slope[0], speed, 1e-8) << name;
    EXPECT_NEAR(impact_power(m).slope[0], power, 1e-8) << name;
  }
}

/// Motion with ever more impacts comes near it from above, motion that rests from below, and both find the same value.
TEST(ChatterLimit, is_where_grazes_accumulate_and_rests_vanish) {
  const BranchSettings settings{.range = {0.2, 1.1}};
  const Branches down = follow_branches(two_stops(0.8), settings), up = follow_branches(two_stops(0.3), settings);
  const std::vector<double> one = special_values(down, SpecialKind::chatter_limit, Parameter("nu")),
                            other = special_values(up, SpecialKind::chatter_limit, Parameter("nu"));
  ASSERT_EQ(one.size(), 1);
  ASSERT_EQ(other.size(), 1);
  EXPECT_NEAR(one[0], other[0], 1e-14);
  // the impact numbers' grazes accumulate there as a geometric series
  const std::vector<double> grazes = special_values(down, SpecialKind::graze, Parameter("nu"));
  ASSERT_GT(grazes.size(), 10);
  const double a = grazes[2] - grazes[1], b = grazes[1] - grazes[0], ratio = b / a;
  EXPECT_NEAR(grazes[0] - b * ratio / (1 - ratio), one[0], 0.02 * b);
  EXPECT_NEAR(ratio, 0.6, 0.02);
}

TEST(ChatterLimit, separates_runs_that_rest_from_runs_that_do_not) {
  const Branches found = follow_branches(two_stops(0.3), {.range = {0.2, 1.1}});
  const double limit = special_values(found, SpecialKind::chatter_limit, Parameter("nu")).at(0);
  EXPECT_TRUE(resting_orbit(two_stops(limit * (1 - 1e-13)), Side::upper, 1));
  EXPECT_FALSE(resting_orbit(two_stops(limit * (1 + 1e-13)), Side::upper, 1));
}

/// Without restitution there is no chatter: the landing itself comes to be at the release. Then half a period's flight
/// from one stop's release ends on the other, which is one equation for nu.
TEST(ChatterLimit, without_restitution_joins_landings_that_rest_and_landings_that_do_not) {
  const auto at = [](double nu) {
    point::Problem problem = two_stops(nu);
    problem.stops = {-0.5, 0.5, 0.0, 0.0};
    return problem;
  };
  const BranchSettings settings{.range = {1.0, 3.0}};
  const Branches down = follow_branches(at(2.0), settings), up = follow_branches(at(1.2), settings);
  for (const Branches& found : {down, up}) {
    for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << end.reason;
    const std::vector<double> limits = special_values(found, SpecialKind::chatter_limit, Parameter("nu"));
    ASSERT_EQ(limits.size(), 1);
    const double nu = limits[0], h = 0.1, g = 0.5;
    const auto flow = free_flow(h, 1.0, std::numbers::pi / nu);
    const Response<double> response = steady_response(h, 1.0, nu);
    const double sine = -g, cosine = std::sqrt(1 - g * g);  // released from the lower stop: f sin = -g, rising
    const double x = response.displacement(sine, cosine), v = response.velocity(nu, sine, cosine);
    EXPECT_NEAR(-x + flow[0] * (-g - x) + flow[1] * -v, g, 1e-12);
    const auto limit = std::ranges::find(found.special, SpecialKind::chatter_limit, &SpecialPoint::kind);
    EXPECT_EQ(limit->branches.size(), 2);
    EXPECT_EQ(special_values(found, SpecialKind::fold, Parameter("nu")).size(), 1);
    std::size_t resting = 0, landing = 0;
    for (const BranchPoint& point : found.points) {
      const double here = point.scene.oscillator.frequency;
      if (point.orbit.size() == 0) continue;
      EXPECT_TRUE(point.orbit.rests() ? here <= nu + 1e-9 : here >= nu - 1e-9 || !point.stable) << here;
      ++(point.orbit.rests() ? resting : landing);
    }
    EXPECT_GT(resting, 20);
    EXPECT_GT(landing, 20);
  }
}

TEST(ReleaseTangency, is_where_load_and_force_balance) {
  const Branches along_load = follow_branches(loaded(0.3), {.along = Parameter("load"), .range = {-0.5, 2.0}});
  EXPECT_EQ(special_values(along_load, SpecialKind::release_tangency, Parameter("load")), (std::vector<double>{1.2}));
  const Branches along_force = follow_branches(loaded(0.3), {.along = Parameter("f"), .range = {0.01, 3.0}});
  const std::vector<double> force = special_values(along_force, SpecialKind::release_tangency, Parameter("f"));
  ASSERT_EQ(force.size(), 1);
  EXPECT_NEAR(force[0], 0.1, 1e-16);
}

TEST(RestingBranch, has_its_largest_speed_where_no_neighbour_is_faster) {
  const Branches found = follow_branches(loaded(0.3), {.along = Parameter("load"), .range = {-0.5, 2.0}});
  const std::vector<double> best = special_values(found, SpecialKind::impact_speed, Parameter("load"));
  ASSERT_EQ(best.size(), 1);
  const auto speed_at = [](double load) { return impact_speed(resting_orbit(loaded(load), Side::upper, 1).value()); };
  EXPECT_LT(speed_at(best[0] - 1e-5), speed_at(best[0]));
  EXPECT_LT(speed_at(best[0] + 1e-5), speed_at(best[0]));
  EXPECT_NEAR(speed_at(best[0] - 1e-5), speed_at(best[0] + 1e-5), 1e-13);
}

TEST(RestingOrbit, has_a_letter_for_each_chatter_and_each_landing_without_restitution) {
  for (const double R : {0.0, 1e-10, 0.3}) {
    point::Problem problem = two_stops(0.3);
    problem.stops.restitution_lower = problem.stops.restitution_upper = R;
    const auto orbit = resting_orbit(problem, Side::upper, 1);
    ASSERT_TRUE(orbit);
    EXPECT_EQ(letters_of(*orbit), "L*U*") << R;
  }
}

/// Beyond the limit of one stop's chatter the mass may still rest on the other: that motion is the one of runs.
TEST(ChatterLimit, of_one_stop_leads_to_motion_that_rests_on_the_other) {
  point::Problem problem = two_stops(0.3);
  problem.stops.lower = -0.5, problem.stops.upper = 0.5;
  const Branches found = follow_branches(problem, {.along = Parameter("load"), .range = {0.0, 1.0}});
  const double limit = special_values(found, SpecialKind::chatter_limit, Parameter("load")).at(0);
  for (const double load : {limit + 1e-3, 0.3, 0.6}) {
    problem.oscillator.load = load;
    const auto orbit = resting_orbit(problem, Side::upper, 1);
    ASSERT_TRUE(orbit) << load;
    const auto holds = [&](std::size_t i) {
      const BranchPoint &one = found.points[i], &other = found.points[i + 1];
      const double a = one.scene.oscillator.load, b = other.scene.oscillator.load;
      return one.branch == other.branch && std::min(a, b) <= load && load <= std::max(a, b) &&
             one.orbit.word() == orbit->word();
    };
    std::size_t i = 0;
    while (i + 1 < found.points.size() && !holds(i)) ++i;
    EXPECT_LT(i + 1, found.points.size()) << load;
  }
}

/// Several cascades, of motion and of its doubled periods, end in the same chatter limit.
TEST(RestingBranch, is_followed_once) {
  point::Problem problem;
  problem.oscillator = {0.02, 1.0, 1.26176, 0.0};
  problem.stops.upper = 0.798751, problem.stops.restitution_upper = 0.214054;
  const Branches found = follow_branches(problem, {.range = {0.05, 2.0}, .generations = 1});
  std::vector<std::size_t> resting;
  for (const BranchPoint& point : found.points)
    if (point.orbit.rests() && (resting.empty() || resting.back() != point.branch)) resting.push_back(point.branch);
  EXPECT_EQ(resting.size(), 1);
  const auto limit = std::ranges::find(found.special, SpecialKind::chatter_limit, &SpecialPoint::kind);
  ASSERT_NE(limit, found.special.end());
  for (const BranchEnd& end : found.ends) {
    if (end.reason == "chatter limit") {
      EXPECT_EQ(std::ranges::count(limit->branches, end.branch), 1) << end.branch;
    }
  }
}

/// A turning point of a flight touches the other stop, or an impact there vanishes: the branch goes on with another
/// word.
TEST(RestingBranch, goes_on_beyond_its_grazes) {
  point::Problem problem = two_stops(0.11874782922099245);
  problem.oscillator.damping = 0.05, problem.oscillator.load = 0.5;
  problem.stops = {-0.4552050132325942, 0.4552050132325942, 0.8, 0.8};
  const Branches found = follow_branches(problem, {.range = {0.05, 0.5}});
  std::size_t grazes = 0;
  for (const SpecialPoint& special : found.special) {
    if (special.kind != SpecialKind::graze || !special.at.orbit.rests()) continue;
    ++grazes;
    ASSERT_EQ(special.branches.size(), 2);
    const auto last = std::ranges::find(found.points, special.branches[1], &BranchPoint::branch);
    ASSERT_NE(last, found.points.end());
    EXPECT_NEAR(last->scene.oscillator.frequency, special.at.scene.oscillator.frequency, 1e-14);
    EXPECT_NE(letters_of(last->orbit.whole()), letters_of(special.at.orbit.whole()));
    const double speeds[] = {slowest_letter(last->orbit.whole()), slowest_letter(special.at.orbit.whole())};
    EXPECT_LT(std::min(speeds[0], speeds[1]), 1e-6);
  }
  EXPECT_GT(grazes, 5);
}

}  // namespace
}  // namespace clatter::branches::resting_test
