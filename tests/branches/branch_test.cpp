#include "branches/branch.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "branches/branch_dataset.hpp"
#include "branches/equations/newton.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/special_values.hpp"
#include "point/point.hpp"
#include "support/random.hpp"

namespace clatter::branches::branch_test {
namespace {

point::Problem problem_of(double h, double f, double nu, const Stops& stops) {
  point::Problem problem;
  problem.oscillator = {h, f, nu, 0.0};
  problem.stops = stops;
  problem.observe.energy = true;
  problem.observe.harmonics = 1;
  return problem;
}

void expect_values(const Branches& found, SpecialKind kind, const std::vector<double>& expected, double tolerance,
                   Parameter along = Parameter("nu")) {
  const std::vector<double> all = special_values(found, kind, along);
  ASSERT_EQ(all.size(), expected.size()) << name_of(kind);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(all[i], expected[i], tolerance) << name_of(kind);
}

Branches close_stops() {
  point::Problem problem = problem_of(0.1, 1.0, 2.0, {-0.5, 0.5, 0.7, 0.7});
  problem.start = {0.1, 1.0, 0.0};
  return follow_branches(problem, {.range = {1.1, 4.0}});
}

TEST(Branch, of_one_impact_on_each_stop_has_the_special_points_of_the_closed_form) {
  const Branches found = close_stops();
  expect_values(found, SpecialKind::fold, {3.65080754705866}, 2e-14 * 4);
  expect_values(found, SpecialKind::symmetry_breaking, {1.15313374708019, 1.37905839709560}, 2e-14);
  expect_values(found, SpecialKind::impact_speed, {3.57894194029580}, 1e-12);
  expect_values(found, SpecialKind::impact_power, {3.61729139744561}, 1e-12);
  for (const SpecialPoint& special : found.special) {
    const auto& [kind, at, branches, condition, left_out] = special;
    EXPECT_EQ(left_out, kind == SpecialKind::symmetry_breaking);  // no generation of what is born there is followed
    if (kind == SpecialKind::impact_speed) {
      EXPECT_NEAR(at.orbit.events[0].before, 1.27925555852649, 1e-14);
    }
    if (kind == SpecialKind::fold || kind == SpecialKind::symmetry_breaking) {
      EXPECT_NEAR(at.multiplier_re[0], 1.0, 1e-10);
      EXPECT_EQ(impact_map(at.scene, at.orbit).trace() > 0, kind == SpecialKind::fold);  // of half a period: +1, -1
    }
  }
}

/// Where an impact is dropped in a graze, what is left may repeat sooner. By runs of the simulator, which doesn't know
/// of branches, from the states of those motions that a run holds on to.
TEST(Branch, of_random_scenes_has_the_shortest_period_everywhere) {
  std::size_t compared = 0;
  for (std::uint64_t index = 0; index < 80; ++index) {
    support::Random random(60, index);
    point::Problem problem =
        problem_of(random.logarithmic(5e-3, 0.1), random.uniform(0.5, 2.5), random.uniform(0.7, 4), {});
    problem.stops.upper = random.uniform(0.1, 1), problem.stops.restitution_upper = random.uniform(0.5, 0.95);
    problem.start.displacement = -0.2;
    const double nu = problem.oscillator.frequency;
    Branches found;
    try {
      found = follow_branches(problem, {.range = {0.6 * nu, 1.7 * nu}, .max_points = 500, .generations = 1});
    } catch (const StartError&) {
      continue;
    }
    for (std::size_t i = 1; i < found.points.size(); i += 7) {
      const BranchPoint& point = found.points[i];
      const double turns = point.orbit.period_ratio(),
                   largest = std::hypot(point.multiplier_re[0], point.multiplier_im[0]);
      const bool is_birth = std::abs(point.multiplier_re[0] - 1) < 1e-4;  // there it is the motion that it is born from
      if (is_birth || point.orbit.rests() || turns != std::floor(turns) || turns < 2 || largest > 1e3) continue;
      const PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
      const double size = std::max(std::abs(from.x), std::abs(from.v));
      for (double part = 1; part < turns; ++part) {
        if (std::fmod(turns, part) != 0) continue;
        const auto later =
            attractors::state_after(attractors::started(with_scene(problem, point.scene), from, 0.0), part);
        ASSERT_TRUE(later);
        EXPECT_GT(std::max(std::abs(later->x - from.x), std::abs(later->v - from.v)), 1e-7 * size)
            << index << ' ' << i << ": " << part << " of " << turns;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(Branch, turns_in_its_fold_and_loses_stability_there) {
  const Branches found = close_stops();
  bool stable = false, unstable = false;
  for (const BranchPoint& point : found.points) {
    if (point.branch != 0 || point.scene.oscillator.frequency < 1.8) continue;
    EXPECT_LE(point.scene.oscillator.frequency, 3.65080754705867);
    (point.stable ? stable : unstable) = true;
  }
  EXPECT_TRUE(stable && unstable);
}

TEST(Branch, has_only_motion_between_the_stops) {
  const Branches found = close_stops();
  for (const BranchPoint& point : found.points) {
    if (std::ranges::any_of(point.orbit.events, [](const OrbitEvent& i) { return std::abs(i.before) < 1e-6; }))
      continue;
    const observables::Extrema::Values range = extrema(point.scene, point.orbit);
    EXPECT_LE(range.x_max, 0.5 * (1 + 1e-9)) << point.arclength;
    EXPECT_GE(range.x_min, -0.5 * (1 + 1e-9)) << point.arclength;
  }
}

/// The paper's Fig. 23, from where both motions attract: one fold, and the graze where the stops are as far away as the
/// response reaches.
TEST(Branch, of_the_papers_scene_ends_where_the_response_grazes) {
  point::Problem problem = problem_of(0.1, -1.0, 1.1, {-3.0, 3.0, 0.7, 0.7});
  problem.start = {2.0, 3.0, 0.0};
  const Branches found = follow_branches(problem, {.range = {0.85, 1.5}});
  expect_values(found, SpecialKind::graze, {1.11687761860245}, 2e-14);
  expect_values(found, SpecialKind::fold, {1.42486182628998}, 2e-14);
  const SpecialPoint& graze =
      *std::ranges::find(found.special, SpecialKind::graze, [](const SpecialPoint& s) { return s.kind; });
  EXPECT_EQ(graze.branches, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(steady_response(0.1, 1.0, graze.at.scene.oscillator.frequency).amplitude, 3.0, 1e-13);
  const BranchPoint& last = found.points.back();  // of the response, taken up at the graze
  EXPECT_EQ(last.orbit.size(), 0);
  EXPECT_TRUE(last.stable);
  EXPECT_EQ(last.scene.oscillator.frequency, 1.5);
}

/// Stability on the branch is that of the motion itself: what is stable attracts, by a run of its own.
TEST(Branch, is_stable_where_a_run_stays_on_it) {
  point::Problem problem = problem_of(0.1, -1.0, 1.1, {-3.0, 3.0, 0.7, 0.7});
  problem.start = {2.0, 3.0, 0.0};
  const Branches found = follow_branches(problem, {.range = {0.85, 1.5}, .generations = 1});
  std::size_t compared = 0;
  for (std::size_t i = 0; i < found.points.size(); i += 7) {
    const BranchPoint& point = found.points[i];
    const double modulus = std::hypot(point.multiplier_re[0], point.multiplier_im[0]);
    if (point.orbit.size() == 0 || std::abs(modulus - 1) < 0.05 || modulus > 1e3) continue;
    point::Problem run = problem;
    static_cast<Scene&>(run) = point.scene;
    const PhasePoint state = state_at_phase_zero(point.scene, point.orbit);
    run.start = {state.x + 1e-7, state.v, 0.0};
    run.observe = {}, run.observe.attractor = true;
    point::ThreadScratch scratch;
    const point::PointResult result = run_point(run, scratch);
    const bool stays = std::hypot(result.attractor_x - state.x, result.attractor_v - state.v) < 1e-6;
    EXPECT_EQ(stays, point.stable) << point.scene.oscillator.frequency << ' ' << point.orbit.word();
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

/// Flips of one stop's motion over two forcing periods: VIVID (arXiv 2510.16218, its tables).
TEST(Branch, flips_where_vivid_says) {
  for (const auto& known : {std::pair(0.81, 0.347533397412283), {0.90011, 0.354356256854738}}) {
    const double nu = known.first, flip = known.second;
    Stops stops;
    stops.upper = 1.0, stops.restitution_upper = 0.9;
    point::Problem problem = problem_of(0.02, 0.36, nu, stops);
    // a motion of period 2 near x0, v0 at forcing phase 0, found from several starts
    std::optional<Branches> found;
    for (double v = -1.0; v <= 1.0 && !found; v += 0.1)
      for (double x = -0.4; x <= 0.4 && !found; x += 0.1) {
        problem.start = {x, v, 0.0};
        try {
          Branches all = follow_branches(problem, {.along = Parameter("f"), .range = {0.34, 0.42}, .period = 2});
          if (!special_values(all, SpecialKind::flip, Parameter("f")).empty()) found = std::move(all);
        } catch (const StartError&) {
        }
      }
    ASSERT_TRUE(found) << nu;
    const std::vector<double> flips = special_values(*found, SpecialKind::flip, Parameter("f"));
    EXPECT_TRUE(std::ranges::any_of(flips, [&](double f) { return std::abs(f - flip) < 1e-12; })) << nu;
  }
}

TEST(Branch, of_doubled_period_begins_in_its_flip) {
  point::Problem problem = problem_of(0.1, -1.0, 1.1, {-3.0, 3.0, 0.7, 0.7});
  problem.start = {2.0, 3.0, 0.0};
  const Branches found = follow_branches(problem, {.range = {0.85, 1.5}, .generations = 2});
  const auto flip = std::ranges::find(found.special, SpecialKind::flip, [](const SpecialPoint& s) { return s.kind; });
  ASSERT_NE(flip, found.special.end());
  EXPECT_NEAR(flip->at.multiplier_re[0], -1.0, 1e-9);
  ASSERT_EQ(flip->branches.size(), 2);
  const auto first = std::ranges::find(found.points, flip->branches[1], &BranchPoint::branch);
  EXPECT_EQ(first->orbit.period_ratio(), 2 * flip->at.orbit.period_ratio());
  EXPECT_EQ(first->scene.oscillator.frequency, flip->at.scene.oscillator.frequency);
}

TEST(Branch, measures_are_the_observables_of_a_run) {
  point::Problem problem = problem_of(0.1, 1.0, 2.0, {-0.5, 0.5, 0.7, 0.7});
  problem.start = {0.1, 1.0, 0.0};
  problem.observe.extrema = true, problem.observe.harmonics_method = observables::HarmonicsMethod::exact;
  point::ThreadScratch scratch;
  const point::PointResult run = run_point(problem, scratch);
  const Orbit orbit = start_orbit(problem, 0, true);
  const OrbitEquations equations(problem, orbit, {{Parameter("nu"), 1.0}}, 1.0);
  const Vector z = equations.unknowns_of(problem, orbit), still(z.size(), 0.0);
  EXPECT_NEAR(impact_power(moving(equations, z, still)).value, run.impact_power, 1e-12);
  EXPECT_NEAR(harmonic(moving(equations, z, still)).value, run.x_spectrum.amplitude[1], 1e-12);
  const observables::Extrema::Values range = extrema(problem, orbit);
  EXPECT_NEAR(range.x_max, run.x_max, 1e-12);
  EXPECT_NEAR(range.v_max, run.v_max, 1e-11);
}

/// A load, or one stop that moves, takes the symmetry away: no half of a motion stands for the other then.
TEST(Branch, of_motion_that_loses_its_symmetry_by_the_parameter_is_that_of_runs) {
  for (const Parameter along : {Parameter("load"), Parameter("stop_upper"), Parameter("R_upper")}) {
    point::Problem problem = problem_of(0.1, 1.0, 2.0, {-0.5, 0.5, 0.7, 0.7});
    problem.start = {0.1, 1.0, 0.0};
    const double here = value_of(problem, along);
    const Branches found = follow_branches(problem, {.along = along, .range = {here - 0.05, here + 0.05}});
    for (const std::size_t i : {std::size_t{0}, found.points.size() - 1}) {
      const BranchPoint& point = found.points[i];
      ASSERT_TRUE(point.stable);
      EXPECT_FALSE(point.orbit.mirrored);
      EXPECT_NEAR(std::abs(value_of(point.scene, along) - here), 0.05, 1e-15);
      point::Problem run = problem;
      static_cast<Scene&>(run) = point.scene;
      run.observe = {}, run.observe.attractor = true, run.start = {0.1, 1.0, 0.0};
      point::ThreadScratch scratch;
      const point::PointResult result = run_point(run, scratch);
      const PhasePoint state = state_at_phase_zero(point.scene, point.orbit);
      EXPECT_NEAR(result.attractor_x, state.x, 1e-10);
      EXPECT_NEAR(result.attractor_v, state.v, 1e-10);
    }
  }
}

TEST(Branch, may_begin_on_a_bound_of_its_range) {
  point::Problem problem = problem_of(0.1, 1.0, 1.1, {-3.0, 3.0, 0.7, 0.7});
  problem.start = {2.0, 3.0, 0.0};
  for (const std::array<double, 2> range : {std::array{0.9, 1.1}, std::array{1.1, 1.3}}) {
    const Branches found = follow_branches(problem, {.range = range});
    for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << end.reason;
    EXPECT_GT(found.points.size(), 10);
    for (const BranchPoint& point : found.points) {
      EXPECT_GE(point.scene.oscillator.frequency, range[0] - 2e-16);
      EXPECT_LE(point.scene.oscillator.frequency, range[1] + 2e-16);
    }
  }
}

TEST(Branch, of_small_motion_at_its_start_takes_no_more_points) {
  const auto points = [](double f) {
    const point::Problem problem = problem_of(0.1, f, 1.1, {-3.0, 3.0, 0.7, 0.7});
    return follow_branches(problem, {.along = Parameter("f"), .range = {0.0, 1.0}}).points.size();
  };
  EXPECT_LT(points(1e-3), 2 * points(0.5));
}

TEST(Branch, at_critical_damping_is_like_its_neighbours) {
  const auto speeds = [](double h) {
    point::Problem problem = problem_of(h, 1.0, 0.6, {-0.3, 0.3, 0.7, 0.7});
    problem.start = {0.0, 1.0, 0.0};
    const Branches found = follow_branches(problem, {.range = {0.55, 0.7}});
    return std::pair(impact_speed(found.points.front().orbit), impact_speed(found.points.back().orbit));
  };
  const auto below = speeds(1 - 1e-9), at = speeds(1.0);
  EXPECT_GT(at.first, 0.01);
  EXPECT_NEAR(at.first, below.first, 1e-7);
  EXPECT_NEAR(at.second, below.second, 1e-7);
}

TEST(Branch, refuses_starts_that_it_cannot_follow) {
  const auto follow = [](const point::Problem& problem) { return follow_branches(problem, {.range = {0.5, 3.0}}); };
  EXPECT_THROW((void)follow(problem_of(0.1, 0.0, 1.0, {-1.0, 1.0, 0.7, 0.7})), StartError);
  EXPECT_THROW((void)follow(problem_of(0.1, 1.0, 3.5, {-1.0, 1.0, 0.7, 0.7})), StartError);  // outside the range
  const point::Problem uneven = problem_of(0.1, 1.0, 1.0, {-1.0, 2.0, 0.7, 0.5});
  EXPECT_THROW((void)follow_branches(uneven, {.along = Parameter("xs"), .range = {0.5, 3}}), StartError);
  EXPECT_THROW((void)follow_branches(uneven, {.along = Parameter("R"), .range = {0.1, 1}}), StartError);
  point::Problem chaos = problem_of(0.1, 1.0, 2.8, {});
  chaos.stops.upper = 0.0, chaos.stops.restitution_upper = 0.7;
  chaos.time.max_periods = 50;
  EXPECT_THROW((void)follow(chaos), StartError);
  point::Problem pressed = problem_of(0.1, 1.0, 1.0, {});
  pressed.stops.upper = 0.2, pressed.stops.restitution_upper = 0.5, pressed.oscillator.load = 2.0;
  EXPECT_THROW((void)follow(pressed), StartError);  // rests for good
}

}  // namespace
}  // namespace clatter::branches::branch_test
