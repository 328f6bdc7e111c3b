// Branches between soft stops, against runs of the integrator and closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "branches/branch.hpp"
#include "branches/bumpers.hpp"
#include "branches/measures/measures.hpp"
#include "branches/special_values.hpp"
#include "branches/start/start.hpp"
#include "point/exact_motion.hpp"
#include "support/soft_scene.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::soft_test {
namespace {

/// A run of the integrator over one period of a motion, with its derivative.
struct Round {
  PhasePoint end;
  double trace;
};

std::optional<Round> round_of(const point::Problem& given, const BranchPoint& point, double aside = 0.0) {
  point::Problem problem = with_scene(given, point.scene);
  sweep::enter_shaken_frame(problem);
  PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
  from.x += aside;
  problem = attractors::started(problem, from, 0.0);
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  recorder.watch.differentiate();
  motion::State<double> state = motion->start();
  if (motion->run_for(state, point.orbit.period_ratio(), recorder) != stepping::Outcome::completed) return std::nullopt;
  const motion::Jacobian<double> m = recorder.watch.derivative();
  return Round{{state.x, state.v}, m[0] + m[3]};
}

double largest_multiplier(const BranchPoint& point) {
  return std::hypot(point.multiplier_re[0], point.multiplier_im[0]);
}

/// Branches of a random scene along its force or its frequency; nothing if it settles on no periodic motion.
std::optional<Branches> branches_of(const point::Problem& problem, bool along_force) {
  const double nu = problem.oscillator.frequency, f = problem.oscillator.forcing;
  BranchSettings settings{.range = {0.7 * nu, 1.4 * nu}, .max_points = 600, .generations = 1};
  if (along_force)
    settings.along = Parameter("f"), settings.range = {std::min(0.5 * f, 2 * f), std::max(0.5 * f, 2 * f)};
  try {
    return follow_branches(problem, settings);
  } catch (const StartError&) {
    return std::nullopt;
  }
}

/// Every point of a branch is a motion of the integrator, which shares neither the equations nor the proofs of whole
/// orbits with it: its map over one period has the state as a fixed point, and the multipliers as eigenvalues. The ends
/// of branches are left out, since there a run may take a graze or not.
TEST(SoftBranch, of_random_scenes_has_only_fixed_points_of_the_integrator) {
  std::size_t scenes = 0, points = 0, renewals = 0, ends = 0, failed = 0;
  for (std::uint64_t index = 0; index < 120; ++index) {
    point::Problem problem = support::soft_scene(index);
    if (problem.oscillator.forcing == 0) continue;
    problem.time = {};
    problem.time.max_periods = 2000;
    const std::optional<Branches> found = branches_of(problem, index % 3 == 0);
    if (!found) continue;
    ++scenes, ends += found->ends.size();
    failed += static_cast<std::size_t>(std::ranges::count_if(
        found->ends, [](const BranchEnd& end) { return end.failed && end.reason != max_points_spent; }));
    for (std::size_t i = 1; i + 1 < found->points.size(); ++i) {
      const BranchPoint& point = found->points[i];
      if (found->points[i - 1].branch != point.branch || found->points[i + 1].branch != point.branch) continue;
      const auto slow = [](const OrbitEvent& impact) { return std::abs(impact.before) < 1e-5; };
      if (std::ranges::any_of(point.orbit.events, slow)) continue;
      const std::optional<Round> round = round_of(problem, point);
      ASSERT_TRUE(round) << index;
      const PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
      const double scale = 1 + largest_multiplier(point);
      EXPECT_LT(std::hypot(round->end.x - from.x, round->end.v - from.v), 1e-9 * scale)
          << index << ' ' << point.arclength << ' ' << point.orbit.word();
      // the states agree to 1e-11, which in long words changes their derivatives by more
      const std::optional<Round> near = round_of(problem, point, 1e-11);
      ASSERT_TRUE(near) << index;
      EXPECT_NEAR(round->trace, point.multiplier_re[0] + point.multiplier_re[1],
                  1e-9 * scale + 2 * std::abs(near->trace - round->trace))
          << index << ' ' << point.arclength << ' ' << point.orbit.word();
      ++points;
      renewals +=
          static_cast<std::size_t>(std::ranges::count(point.orbit.events, Event::Kind::renewal, &OrbitEvent::kind));
    }
  }
  EXPECT_GT(scenes, 80);
  EXPECT_GT(ends, 300);
  EXPECT_LE(failed, ends / 100);
  EXPECT_GT(points, 10000);
  EXPECT_GT(renewals, 100);
}

double fold_of(const point::Problem& problem) {
  const Branches found = follow_branches(problem, {.range = {0.85, 1.5}});
  const std::vector<double> folds = special_values(found, SpecialKind::fold, Parameter("nu"));
  return folds.empty() ? std::numeric_limits<double>::quiet_NaN() : folds.front();
}

/// By eq. 55 the deviation falls with the time of contact, kappa^(-1/2).
TEST(SoftBranch, tends_to_that_between_rigid_stops_of_equal_restitution) {
  const double zeta = 0.1, root = std::sqrt(1 - zeta * zeta);
  const double R = std::exp(-2 * zeta * std::acos(zeta) / root);
  point::Problem rigid = bumpers(1.0, 0.0);
  rigid.stops = {-3.0, 3.0, R, R};
  const double limit = fold_of(rigid), near = fold_of(bumpers(1e8, zeta)) - limit,
               nearer = fold_of(bumpers(1e10, zeta)) - limit;
  EXPECT_LT(std::abs(nearer), 1e-4);
  EXPECT_NEAR(near / nearer, 10.0, 0.05);
}

/// At its graze the response reaches the stops, rigid or soft: its amplitude is their distance.
TEST(SoftBranch, begins_where_the_response_grazes_the_bumpers) {
  for (const double zeta : {0.0, 0.1, 2.0}) {
    const Branches found = follow_branches(bumpers(200.0, zeta), {.range = {0.85, 4.0}});
    const std::vector<double> grazes = special_values(found, SpecialKind::graze, Parameter("nu"));
    ASSERT_GE(grazes.size(), 1) << zeta;
    for (const double nu : grazes) EXPECT_NEAR(steady_response(0.1, 1.0, nu).amplitude, 3.0, 1e-12) << zeta;
    const auto meets = [](const BranchPoint& point) { return point.orbit.meets_soft_stop(); };
    EXPECT_TRUE(std::ranges::any_of(found.points, meets)) << zeta;
    EXPECT_FALSE(std::ranges::all_of(found.points, meets)) << zeta;
  }
}

/// A preload keeps the mass in contact: motion without events is the response of the pressed oscillator.
TEST(SoftBranch, of_a_mass_that_is_always_in_contact_is_the_pressed_response) {
  point::Problem problem;
  problem.oscillator = {0.1, 0.2, 0.5, 5.0};
  problem.stops.upper = 0.5;
  problem.stops.stiffness_upper = 10.0, problem.stops.damping_upper = 0.2;
  problem.start = {1.0, 0.0, 0.0};
  const Branches found = follow_branches(problem, {.range = {0.3, 1.0}});
  const double h = 0.1 + 0.2 * std::sqrt(10.0), k = 11.0;
  for (const BranchPoint& point : found.points) {
    ASSERT_EQ(point.orbit.pressed, Side::upper);
    const double nu = point.scene.oscillator.frequency;
    const std::complex<double> response = 0.2 / std::complex(k - nu * nu, 2 * h * nu);  // of sin(phase)
    const PhasePoint state = state_at_phase_zero(point.scene, point.orbit);
    EXPECT_NEAR(state.x, (5.0 + 10.0 * 0.5) / k + response.imag(), 1e-14);
    EXPECT_NEAR(state.v, nu * response.real(), 1e-14);
    const double period = 2 * std::numbers::pi / nu;
    EXPECT_NEAR(std::hypot(point.multiplier_re[0], point.multiplier_im[0]), std::exp(-h * period), 1e-14);
  }
}

/// A fold along a number of the stops is a fold along the frequency of the scene there.
TEST(SoftBranch, has_its_folds_along_the_numbers_of_the_stops) {
  const Branches along_nu = follow_branches(bumpers(70.0, 0.1), {.range = {0.85, 1.5}});
  const auto high = [](const BranchPoint& point) {
    return point.stable && point.orbit.size() > 0 && point.scene.oscillator.frequency > 1.3;
  };
  const auto begin = std::ranges::find_if(along_nu.points, high);
  ASSERT_NE(begin, along_nu.points.end());
  point::Problem problem = with_scene(bumpers(70.0, 0.1), begin->scene);
  const PhasePoint state = state_at_phase_zero(begin->scene, begin->orbit);
  problem.start = {state.x, state.v, 0.0};
  for (const Parameter along : {Parameter("stop_stiffness"), Parameter("stop_damping")}) {
    const bool stiffness = along == Parameter("stop_stiffness");
    const Branches found = follow_branches(
        problem, {.along = along, .range = stiffness ? std::array{10.0, 90.0} : std::array{0.02, 0.9}, .period = 1});
    const auto fold = std::ranges::find(found.special, SpecialKind::fold, &SpecialPoint::kind);
    ASSERT_NE(fold, found.special.end()) << along.key();
    EXPECT_NEAR(fold->at.multiplier_re[0], 1.0, 1e-9);
    const double there = value_of(fold->at.scene, along);
    EXPECT_NEAR(fold_of(bumpers(stiffness ? there : 70.0, stiffness ? 0.1 : there)), begin->scene.oscillator.frequency,
                1e-11)
        << along.key();
  }
}

/// A mass on a spring bumper without a damper, pressed by a load: it leaves the bumper once the amplitude of the
/// pressed response exceeds its mean depth, load over the stiffness of both springs.
TEST(SoftBranch, begins_to_hop_where_the_pressed_response_leaves_the_bumper) {
  point::Problem problem;
  problem.oscillator = {0.1, 0.2, 0.5, 5.0};
  problem.stops.upper = 0.5;
  problem.stops.stiffness_upper = 10.0;
  problem.start = {1.0, 0.0, 0.0};
  const Branches found = follow_branches(problem, {.along = Parameter("f"), .range = {0.1, 8.0}});
  EXPECT_TRUE(std::ranges::none_of(found.ends, &BranchEnd::failed));
  const double k = 11.0, depth = (5.0 + 10.0 * 0.5) / k - 0.5;
  const double limit = depth * std::hypot(k - 0.25, 2 * 0.1 * 0.5);
  const std::vector<double> grazes = special_values(found, SpecialKind::graze, Parameter("f"));
  ASSERT_FALSE(grazes.empty());
  EXPECT_NEAR(grazes.front(), limit, 1e-12 * limit);
  const auto hops = [](const BranchPoint& point) { return point.orbit.size() > 0; };
  for (const BranchPoint& point : found.points) {
    const double f = point.scene.oscillator.forcing;
    EXPECT_TRUE(hops(point) == (f > limit) || std::abs(f - limit) < 1e-3) << f;
  }
  EXPECT_TRUE(std::ranges::any_of(found.points, hops));
}

/// The free motion is symmetric, so it touches two stops equally far away at once, though they aren't alike. Motion
/// with contacts on both ends there; beyond it there is free motion, and no second branch of contacts.
TEST(SoftBranch, with_two_contacts_may_end_on_free_motion) {
  point::Problem problem;
  problem.oscillator = {0.67, 1.0, 2.9, 0.0};
  problem.oscillator.stiffness = 0.9;
  problem.stops.lower = -0.227, problem.stops.upper = 0.227;
  problem.stops.stiffness_lower = 266, problem.stops.stiffness_upper = 483;
  problem.start = {-0.18, 0.616, 0.0};
  const Branches found = follow_branches(problem, {.range = {2.0, 4.0}, .max_points = 1000});
  const std::vector<double> grazes = special_values(found, SpecialKind::graze, Parameter("nu"));
  ASSERT_EQ(grazes.size(), 1);
  const double nu = grazes.front();
  EXPECT_NEAR(std::hypot(0.9 - nu * nu, 2 * 0.67 * nu), 1.0 / 0.227, 1e-11);
  ASSERT_EQ(found.points.back().branch, 1);
  for (const BranchPoint& point : found.points) {
    const bool in_graze = std::abs(point.scene.oscillator.frequency - nu) < 1e-9;
    EXPECT_TRUE(in_graze || point.orbit.word() == (point.branch == 0 ? "LU" : "-"));
  }
}

}  // namespace
}  // namespace clatter::branches::soft_test
