// Branches without a spring, with an unstable one, and with others, against their closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "branches/branch.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/special_values.hpp"
#include "branches/symmetric_motion.hpp"
#include "point/point.hpp"

namespace clatter::branches::stiffness_test {
namespace {

using std::numbers::pi;

/// A ball on a table that is shaken with the acceleration Gamma, gravity 1, from its impact in a motion that repeats
/// after n periods of the table.
struct BouncingBall {
  int n;
  double R;

  /// n pi (1 - R)/(1 + R): the acceleration at that impact, and the least for which there is one.
  [[nodiscard]] double lowest() const { return n * pi * (1 - R) / (1 + R); }
  [[nodiscard]] double flip() const { return std::hypot(lowest(), 2 * (1 + R * R) / ((1 + R) * (1 + R))); }
  [[nodiscard]] double landing() const { return 2 * pi * n / (1 + R); }

  [[nodiscard]] point::Problem at(double Gamma) const {
    point::Problem problem;
    problem.oscillator = {0.0, Gamma, 1.0, -1.0, 0.0};
    problem.stops = {0.0, std::numeric_limits<double>::infinity(), R, R};
    problem.start = {0.0, landing() * R, std::acos(lowest() / Gamma)};
    return problem;
  }
};

TEST(BouncingBall, repeats_from_its_fold_to_its_flip) {
  for (const BouncingBall ball : {BouncingBall{1, 0.8}, {1, 0.3}, {2, 0.8}, {3, 0.95}}) {
    const double low = ball.lowest(), flip = ball.flip();
    const Branches found =
        follow_branches(ball.at(low + 0.6 * (flip - low)), {.along = Parameter("f"), .range = {0.5 * low, flip + 0.1}});
    const std::vector<double> folds = special_values(found, SpecialKind::fold, Parameter("f")),
                              flips = special_values(found, SpecialKind::flip, Parameter("f"));
    ASSERT_GE(folds.size(), 1) << ball.n << ' ' << ball.R;
    ASSERT_GE(flips.size(), 1) << ball.n << ' ' << ball.R;
    EXPECT_NEAR(folds[0], low, 1e-14 * low);
    EXPECT_NEAR(flips[0], flip, 1e-13 * flip);
    std::size_t stable = 0;
    for (const BranchPoint& point : found.points) {
      if (point.orbit.size() != 1 || point.orbit.half_turns != 2 * ball.n) continue;
      const OrbitEvent& impact = point.orbit.events[0];
      const double Gamma = point.scene.oscillator.forcing;
      EXPECT_NEAR(impact.before, -ball.landing(), 1e-13 * ball.landing()) << Gamma;
      EXPECT_NEAR(Gamma * std::cos(impact.phase), low, 1e-12) << Gamma;
      const double R = ball.R, trace = 1 + R * R - (1 + R) * (1 + R) * Gamma * std::sin(impact.phase);
      EXPECT_NEAR(impact_map(point.scene, point.orbit).trace(), trace, 1e-11) << Gamma;
      EXPECT_EQ(point.stable, std::abs(trace) < 1 + R * R) << Gamma;
      stable += point.stable;
    }
    EXPECT_GT(stable, 10);
  }
}

/// Two walls, no load.
point::Problem between_walls(double h, double nu, double k, double gap, double R) {
  point::Problem problem;
  problem.oscillator = {h, 1.0, nu, 0.0, k};
  problem.stops = {-gap, gap, R, R};
  problem.start = {0.0, 1.5, 0.0};
  problem.observe.energy = true;
  return problem;
}

/// The same from an impact on the upper wall in the faster motion with one impact on each.
point::Problem from_symmetric_motion(double h, double nu, double k, double gap, double R) {
  point::Problem problem = between_walls(h, nu, k, gap, R);
  const SymmetricMotion known(problem);
  const double speed = known.speed(1);
  problem.start = {gap, -R * speed, known.phase(speed)};
  return problem;
}

/// Points of one impact on each stop have the closed form; returns how many.
std::size_t expect_symmetric_motion(const Branches& found) {
  std::size_t compared = 0;
  for (const BranchPoint& point : found.points) {
    const Oscillator& o = point.scene.oscillator;
    if (!point.orbit.mirrored || point.orbit.size() != 1 || point.orbit.half_turns != 1) continue;
    const double critical = std::abs(o.damping * o.damping - o.stiffness);
    if (critical > 0 && critical < 5e-3) continue;  // the closed form's own rounding
    const SymmetricMotion known(point.scene);
    const OrbitEvent& impact = point.orbit.events[0];
    const double speed = std::abs(impact.before), scale = std::max(1.0, known.gap);
    if (known.discriminant < 1e-4 * known.square * scale * scale || speed < 1e-2) continue;  // ill-conditioned there
    const double fast = known.speed(1), slow = known.speed(-1);
    EXPECT_LT(std::min(std::abs(speed - fast), std::abs(speed - slow)), 1e-11 * scale) << o.frequency;
    const double of_force =
        impact.phase + numbers_of<double>(point.scene).force().lead + (impact.side == Side::upper ? 0.0 : pi);
    const double trace = known.trace(speed, of_force);
    EXPECT_NEAR(impact_map(point.scene, point.orbit).trace(), trace, 1e-9 * (1 + std::abs(trace))) << o.frequency;
    ++compared;
  }
  return compared;
}

/// In its folds both motions of the closed form are one.
void expect_folds_of_symmetric_motion(const Branches& found, std::size_t count) {
  std::size_t folds = 0;
  for (const SpecialPoint& special : found.special) {
    if (special.kind != SpecialKind::fold || !special.at.orbit.mirrored || special.at.orbit.size() != 1) continue;
    const SymmetricMotion known(special.at.scene);
    const double g = known.gap;
    EXPECT_NEAR(known.discriminant, 0.0, 1e-12 * known.square * g * g);
    EXPECT_NEAR(std::abs(special.at.orbit.events[0].before), known.alpha * g / known.square, 1e-6);
    ++folds;
  }
  EXPECT_EQ(folds, count);
}

TEST(SymmetricMotion, between_walls_without_a_spring_has_its_closed_form_along_nu) {
  for (const double h : {0.0, 0.1}) {
    const Branches found = follow_branches(from_symmetric_motion(h, 1.5, 0.0, 0.5, 0.6), {.range = {0.8, 4.0}});
    EXPECT_GT(expect_symmetric_motion(found), 100);
    expect_folds_of_symmetric_motion(found, 1);
  }
}

TEST(SymmetricMotion, with_an_unstable_spring_has_its_closed_form_along_nu) {
  for (const double h : {0.0, 0.2}) {
    const Branches found = follow_branches(from_symmetric_motion(h, 1.5, -0.4, 0.5, 0.6), {.range = {0.8, 4.0}});
    EXPECT_GT(expect_symmetric_motion(found), 100);
    expect_folds_of_symmetric_motion(found, 1);
  }
}

/// From an unstable spring over none to one beyond critical damping and k = 1.
TEST(SymmetricMotion, has_its_closed_form_along_the_stiffness) {
  const Branches found =
      follow_branches(between_walls(0.3, 1.5, 1.0, 0.5, 0.6), {.along = Parameter("stiffness"), .range = {-1.5, 3.1}});
  EXPECT_GT(expect_symmetric_motion(found), 60);
  const auto bounds =
      std::ranges::minmax(found.points, {}, [](const BranchPoint& p) { return p.scene.oscillator.stiffness; });
  EXPECT_EQ(bounds.min.scene.oscillator.stiffness, -1.5);
}

TEST(Branch, of_any_spring_is_that_of_1_in_other_units_of_time) {
  point::Problem unit = between_walls(0.1, 2.0, 1.0, 0.5, 0.7), other = unit;
  other.oscillator = {0.2, 4.0, 4.0, 0.0, 4.0}, other.start.velocity *= 2;
  const Branches a = follow_branches(unit, {.range = {1.1, 4.0}}), b = follow_branches(other, {.range = {2.2, 8.0}});
  for (const SpecialKind kind : {SpecialKind::fold, SpecialKind::symmetry_breaking, SpecialKind::impact_speed,
                                 SpecialKind::impact_power, SpecialKind::graze}) {
    const std::vector<double> one = special_values(a, kind, Parameter("nu")),
                              two = special_values(b, kind, Parameter("nu"));
    ASSERT_EQ(one.size(), two.size()) << name_of(kind);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(two[i], 2 * one[i], 1e-11) << name_of(kind);
  }
  ASSERT_EQ(special_values(b, SpecialKind::fold, Parameter("nu")).size(), 1);
}

TEST(Branch, measures_are_the_observables_of_a_run_for_any_stiffness) {
  for (const double k : {0.0, -0.4, 2.5}) {
    point::Problem problem = between_walls(0.1, 1.5, k, 0.5, 0.6);
    problem.observe.extrema = true;
    problem.observe.harmonics = 1, problem.observe.harmonics_method = observables::HarmonicsMethod::exact;
    point::ThreadScratch scratch;
    const point::PointResult run = run_point(problem, scratch);
    const Orbit orbit = start_orbit(problem, 0, true);
    const OrbitEquations equations(problem, orbit, {{Parameter("nu"), 1.0}}, 1.0);
    const Vector z = equations.unknowns_of(problem, orbit), still(z.size(), 0.0);
    EXPECT_NEAR(impact_power(moving(equations, z, still)).value, run.impact_power, 1e-12) << k;
    EXPECT_NEAR(harmonic(moving(equations, z, still)).value, run.x_spectrum.amplitude[1], 1e-12) << k;
    const observables::Extrema::Values range = extrema(problem, orbit);
    EXPECT_NEAR(range.x_max, run.x_max, 1e-12) << k;
    EXPECT_NEAR(range.v_max, run.v_max, 1e-11) << k;
  }
}

/// An unstable equilibrium under a force: its response is a motion without impacts, and unstable.
TEST(Branch, of_the_response_around_an_unstable_equilibrium_ends_where_that_grazes) {
  point::Problem problem = between_walls(0.1, 3.0, -0.5, 0.5, 0.6);
  problem.start = {-1.0 / (9 + 0.5), 0.0, 0.0};
  const Response<double> response = steady_response(problem.oscillator);
  problem.start = {response.displacement(0.0, 1.0), response.velocity(3.0, 0.0, 1.0), 0.0};
  const Branches found = follow_branches(problem, {.range = {1.0, 4.0}, .period = 1});
  EXPECT_EQ(found.points[0].orbit.size(), 0);
  const std::vector<double> grazes = special_values(found, SpecialKind::graze, Parameter("nu"));
  ASSERT_GE(grazes.size(), 1);
  Oscillator there = problem.oscillator;
  there.frequency = grazes.back();
  EXPECT_NEAR(steady_response(there).amplitude, 0.5, 1e-13);
  for (const BranchPoint& point : found.points) {
    if (point.orbit.size() > 0 || point.scene.oscillator.frequency < grazes.back() + 1e-5) continue;
    const double fast = -0.1 - std::sqrt(0.01 + 0.5), slow = -0.1 + std::sqrt(0.01 + 0.5);
    const double period = 2 * pi / point.scene.oscillator.frequency;
    EXPECT_NEAR(point.multiplier_re[0] / std::exp(slow * period), 1, 1e-12);
    EXPECT_NEAR(point.multiplier_re[1] / std::exp(fast * period), 1, 1e-12);
    EXPECT_FALSE(point.stable);
  }
}

TEST(Branch, begins_where_free_motion_is_aperiodic_to_the_limit) {
  // at h^2 = k formulas of free motion change, which the branch begins with; from elsewhere it passes the same motions
  const auto speed_at_end = [](double k, double beyond) {
    const double critical = std::sqrt(k), end = critical + 0.1;
    point::Problem problem = between_walls(critical + 0.05, 1.5, k, 0.5, 0.6);
    problem.oscillator.damping = critical + beyond;
    const Branches found = follow_branches(problem, {.along = Parameter("h"), .range = {critical, end}});
    const auto last = std::ranges::max_element(found.points, {},
                                               [](const BranchPoint& point) { return point.scene.oscillator.damping; });
    EXPECT_EQ(last->scene.oscillator.damping, end) << k;
    return std::abs(last->orbit.events[0].before);
  };
  for (const double k : {0.0, 0.25}) EXPECT_NEAR(speed_at_end(k, 0), speed_at_end(k, 0.03), 1e-12) << k;
}

TEST(Branch, says_why_it_cannot_begin) {
  const auto message = [](const point::Problem& problem, const BranchSettings& settings) -> std::string {
    try {
      static_cast<void>(follow_branches(problem, settings));
    } catch (const StartError& error) {
      return error.what();
    }
    return "";
  };
  const point::Problem free = between_walls(0.0, 1.5, 0.0, 0.5, 0.6);
  EXPECT_NE(message(free, {.along = Parameter("stiffness"), .range = {-1, 1}}).find("at 0; begin"), std::string::npos);
  point::Problem quiet = between_walls(0.1, 4.0, 0.0, 0.5, 0.6);
  quiet.start = {};
  EXPECT_NE(message(quiet, {.range = {3, 5}}).find("without a spring"), std::string::npos);
  point::Problem lost = between_walls(0.1, 1.5, -1.0, 0.5, 0.6);
  lost.stops.upper = std::numeric_limits<double>::infinity(), lost.start = {3.0, 0.0, 0.0};
  EXPECT_NE(message(lost, {.range = {1, 2}}).find("escapes"), std::string::npos);
}

}  // namespace
}  // namespace clatter::branches::stiffness_test
