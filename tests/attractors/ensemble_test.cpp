#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "attractors/ensemble_motions.hpp"
#include "attractors/numbering.hpp"
#include "attractors/tracked_motion.hpp"
#include "point/point.hpp"

namespace clatter::attractors::ensemble_test {
namespace {

/// Fig. 23's oscillator.
point::Problem scene(double nu) {
  point::Problem problem;
  problem.oscillator = {.damping = 0.1, .forcing = -1.0, .frequency = nu};
  problem.stops = {-3.0, 3.0, 0.7, 0.7};
  return problem;
}

PhasePoint response(const point::Problem& problem) { return response_at(problem.oscillator, 0.0, 1.0); }

/// The state and periods of the motion that a start ends in.
Ending ending(const point::Problem& problem, const PhasePoint& start) {
  point::Problem starting = problem;
  starting.start = {start.x, start.v, 0.0};
  starting.observe.attractor = true;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(starting, scratch);
  return {{result.attractor_x, result.attractor_v}, result.attractor_periods};
}

/// The state at forcing phase 0 of the motion with one impact on each stop.
PhasePoint impacting(const point::Problem& problem) {
  for (double v0 = -6; v0 <= 6; v0 += 0.5)
    for (double x0 = -2.5; x0 <= 2.5; x0 += 0.5) {
      const PhasePoint end = ending(problem, {x0, v0}).state, quiet = response(problem);
      if (std::hypot(end.x - quiet.x, end.v - quiet.v) > 0.1) return end;
    }
  ADD_FAILURE() << "no start ends in it";
  return {0, 0};
}

TEST(Ensemble, tells_motions_apart_and_knows_them_again) {
  const point::Problem problem = scene(1.2);
  EnsembleMotions motions(true);
  const PhasePoint quiet = response(problem), loud = impacting(problem);
  EXPECT_EQ(motions.motion_of(problem, {quiet, 1.0}), 0);
  EXPECT_EQ(motions.motion_of(problem, {loud, 1.0}), 1);
  EXPECT_EQ(motions.motion_of(problem, {{quiet.x + 1e-12, quiet.v}, 1.0}), 0);
  // as far away as a loose tolerance leaves it: polished before it is compared
  EXPECT_EQ(motions.motion_of(problem, {{loud.x + 1e-6, loud.v - 1e-6}, 1.0}), 1);
  EXPECT_EQ(motions.motion_of(problem, {loud, 2.0}), 1);  // its own period, seen twice
  EXPECT_EQ(motions.motions().size(), 2);
  EXPECT_EQ(motions.motions()[0].periodic->regime, "0/1");
  EXPECT_EQ(motions.motions()[1].periodic->word, "LU");
}

TEST(Ensemble, knows_a_motion_from_any_forcing_phase) {
  const point::Problem problem = scene(1.2);
  EnsembleMotions motions(true);
  const PhasePoint loud = impacting(problem);
  EXPECT_EQ(motions.motion_of(problem, {loud, 1.0}), 0);
  for (const double phase : {0.7, 3.0, 6.0, -2.0, 20.0}) {
    const double turns = phase / (2 * M_PI);
    const auto there = state_after(started(problem, loud, 0.0), turns - std::floor(turns));
    ASSERT_TRUE(there);
    EXPECT_EQ(motions.motion_of(started(problem, *there, phase), {*there, 1.0}), 0) << phase;
  }
}

TEST(Ensemble, leaves_what_no_point_can_end_in_undecided) {
  const point::Problem problem = scene(1.2);
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EnsembleMotions motions(true);
  for (const Ending& ending : {Ending{{0, 0}, nan},
                               {{0, 0}, -1},
                               {{0, 0}, 65},
                               {{0, 0}, 1e300},
                               {{0, 0}, 0.5},
                               {{nan, 0}, 1},
                               {{0, inf}, 1},
                               {{3.5, 0}, 1},
                               {{-inf, 0}, 0}})
    EXPECT_EQ(motions.motion_of(problem, ending), std::nullopt);
  point::Problem elastic = problem;  // shrinks no areas
  elastic.oscillator.damping = 0;
  EXPECT_EQ(motions.motion_of(elastic, {response(elastic), 1.0}), std::nullopt);
  EXPECT_TRUE(motions.motions().empty());
}

TEST(Ensemble, takes_the_states_before_and_after_an_impact_for_one) {
  const Scene scene{.stops = {-3.0, 3.0, 0.5, 0.7}};
  EXPECT_EQ(after_impact(scene, {-3.0 + 1e-10, -2.0}, 2.0).v, 1.0);
  EXPECT_EQ(after_impact(scene, {3.0, 2.0}, 2.0).v, -1.4);
  EXPECT_EQ(after_impact(scene, {3.0, -2.0}, 2.0).v, -2.0);
  EXPECT_EQ(after_impact(scene, {2.9, 2.0}, 2.0).v, 2.0);
}

TEST(Ensemble, takes_the_states_of_a_loose_mass_before_and_after_an_impact_for_one) {
  const Scene scene{
      .loose = {.ratio = 0.25, .lower = -1.0, .upper = 2.0, .restitution_lower = 0.5, .restitution_upper = 0.5}};
  const SectionState after = after_impact(scene, {0.3, 0.1, -1.0 + 1e-10, -2.0}, 2.0);
  EXPECT_EQ(after.x, 0.3);
  EXPECT_EQ(after.w, 1.0);
  EXPECT_NEAR(after.v + 0.25 * (after.v + after.w), 0.1 + 0.25 * (0.1 - 2.0), 1e-15);  // momentum
  for (const SectionState& other : {SectionState{0.3, 0.1, -1.0, 2.0}, SectionState{0.3, 0.1, 1.9, 2.0}})
    EXPECT_EQ(after_impact(scene, other, 2.0).w, 2.0);
}

TEST(Tracked, motion_is_followed_to_its_fold_and_no_further) {
  const point::Problem from = scene(1.2);
  EnsembleMotions motions(true);
  ASSERT_EQ(motions.motion_of(from, {impacting(from), 1.0}), 0);
  TrackedMotion motion(from, motions.motions()[0]);
  EXPECT_TRUE(motion.follow(scene(1.3)));
  EnsembleMotions there(true);
  const point::Problem to = scene(1.4);
  EXPECT_EQ(there.motion_of(to, {response(to), 1.0}), 0);
  EXPECT_EQ(there.motion_of(to, {impacting(to), 1.0}), 1);
  EXPECT_TRUE(motion.follow(to));
  EXPECT_EQ(motion.among(there), 1);
  TrackedMotion beyond = motion;
  EXPECT_FALSE(beyond.follow(scene(1.6)));  // the fold is between 1.42 and 1.45
  TrackedMotion back = motion;
  EXPECT_FALSE(back.follow(scene(0.96)));  // below 0.98 it attracts no more: a mirror pair does
}

/// An impact passes forcing phase 0 between ν = 2.00 and 2.04: the state there jumps, the motion doesn't.
TEST(Tracked, motion_is_followed_while_an_impact_passes_the_section) {
  const auto one_stop = [](int step) {
    point::Problem problem = scene(1.9 + 0.01 * step);
    problem.stops = {};
    problem.stops.upper = 0.0;
    problem.stops.restitution_upper = 0.5;
    return problem;
  };
  std::size_t jumps = 0;
  for (int step = 0; step < 30; ++step) {
    const point::Problem from = one_stop(step), to = one_stop(step + 1);
    EnsembleMotions here(true), there(true);
    ASSERT_EQ(here.motion_of(from, ending(from, {-0.6, 0.0})), 0);
    ASSERT_EQ(there.motion_of(to, ending(to, {-0.6, 0.0})), 0);
    EXPECT_EQ(here.motions()[0].periodic->word, "U");
    const PhasePoint a = here.motions()[0].state, b = there.motions()[0].state;
    jumps += std::abs(a.v - b.v) > 1.0 ? 1 : 0;
    TrackedMotion motion(from, here.motions()[0]);
    EXPECT_TRUE(motion.follow(to)) << step;
    EXPECT_EQ(motion.among(there), 0) << step;
  }
  EXPECT_EQ(jumps, 1);
}

TEST(Tracked, rest_is_followed_with_its_stop_or_its_equilibrium) {
  point::Problem free;
  free.oscillator = {.damping = 0.1, .load = 0.5};
  free.stops.upper = 1.0;
  free.stops.restitution_upper = 0.5;
  EnsembleMotions motions;
  ASSERT_EQ(motions.motion_of(free, {{0.5, 0.0}, 1.0}), 0);
  TrackedMotion rest(free, motions.motions()[0]);
  point::Problem moved = free;
  moved.oscillator.load = 0.6;
  EnsembleMotions there;
  ASSERT_EQ(there.motion_of(moved, {{0.6, 0.0}, 1.0}), 0);
  EXPECT_TRUE(rest.follow(moved));
  EXPECT_EQ(rest.among(there), 0);
}

TEST(Grid, counts_points_row_major_over_parameters_and_starts) {
  const Grid grid({{2, false}, {3, true}, {5, false}, {4, true}});
  EXPECT_EQ(grid.ensembles(), 10);
  EXPECT_EQ(grid.starts(), 12);
  EXPECT_EQ(grid.lengths(), (std::vector<std::size_t>{2, 5}));
  std::vector<char> seen(120, 0);
  for (std::size_t ensemble = 0; ensemble < 10; ++ensemble)
    for (std::size_t start = 0; start < 12; ++start) {
      const std::size_t point = grid.point(ensemble, start);
      EXPECT_EQ(point, ((ensemble / 5 * 3 + start / 4) * 5 + ensemble % 5) * 4 + start % 4);
      ++seen[point];
      EXPECT_TRUE(start == 0 || point > grid.point(ensemble, start - 1));
    }
  EXPECT_EQ(seen, std::vector<char>(120, 1));
}

}  // namespace
}  // namespace clatter::attractors::ensemble_test
