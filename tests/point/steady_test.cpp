// The steady motion that is found with shortcuts is the one that a long run comes to, and costs a fraction of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>

#include "point/point.hpp"
#include "support/deviation.hpp"
#include "support/random.hpp"
#include "sweep/figures.hpp"

namespace clatter::point::steady_test {
namespace {

PointResult result_of(Problem scene, bool all_effects) {
  scene.integration.all_effects = all_effects;
  ThreadScratch none;
  return run_point(scene, none);
}

/// A point of Figs. 20-23, all of it observed.
Problem figure(double xs, double nu) {
  Problem scene = sweep::paper_scene(xs, nu);
  scene.observe.extrema = scene.observe.period = scene.observe.stability = true;
  scene.time.max_periods = 800;
  return scene;
}

/// The largest difference of two results' extrema, over the larger of all.
double difference(const PointResult& a, const PointResult& b) {
  const double size = std::max({b.x_max, -b.x_min, b.v_max, -b.v_min});
  return std::max({std::abs(a.x_min - b.x_min), std::abs(a.x_max - b.x_max), std::abs(a.v_min - b.v_min),
                   std::abs(a.v_max - b.v_max)}) /
         size;
}

/// A mass that never leaves a stop has none.
bool same_period(const PointResult& a, const PointResult& b) {
  return a.period_ratio == b.period_ratio || (std::isnan(a.period_ratio) && std::isnan(b.period_ratio));
}

TEST(Steady, motion_of_the_figures_is_that_of_a_long_run_for_a_tenth_of_its_periods) {
  double points = 0, periods = 0, newton = 0, closed = 0, worst = 0;
  for (const double xs : {6.0, 5.0, 4.0, 3.0})
    for (int i = 0; i <= 50; ++i) {
      const double nu = 0.5 + i / 50.0;
      // between stops at 5 resonance grazes to 3e-16: which side of it rounding falls on is nobody's to say
      if (xs == 5.0 && nu == 1.0) continue;
      const PointResult all = result_of(figure(xs, nu), true), found = result_of(figure(xs, nu), false);
      if (all.status != steady::Status::periodic) continue;
      ASSERT_EQ(found.status, steady::Status::periodic) << "xs " << xs << ", nu " << nu;
      EXPECT_EQ(found.period_ratio, all.period_ratio) << "xs " << xs << ", nu " << nu;
      // the long run stops within its tolerance of 1e-12 over what a period leaves of a change
      const double left = 1 - std::exp(found.lyapunov * found.period);
      EXPECT_LE(difference(found, all), 1e-12 / std::min(1.0, left)) << "xs " << xs << ", nu " << nu;
      worst = std::max(worst, difference(found, all));
      ++points, periods += found.periods;
      newton += found.found_by == steady::FoundBy::newton, closed += found.found_by == steady::FoundBy::closed_form;
    }
  std::cout << points << " periodic points, " << newton << " by Newton's method, " << closed << " in closed form, "
            << periods / points << " periods each; extrema to " << worst << '\n';
  EXPECT_GT(points, 170);
  EXPECT_GT(newton, 10);
  EXPECT_GT(closed, 100);
  EXPECT_LT(periods, points * 30);  // a tenth of the 300 that repetition to 1e-12 takes at h = 0.1
}

TEST(Steady, motion_of_the_figures_without_a_period_begins_with_the_same_twenty_impacts) {
  // all 81 points of Figs. 21-23 that have none. Chaos multiplies rounding within twenty impacts (two compiled sets
  // that round differently come to be 0.4 of the run apart), so this holds to 1e-12 only as both take the same steps: h
  // = 0.1 has no resonance, and no stop is ever pressed
  const struct {
    double xs, from, to;
  } windows[] = {{5, 0.980, 0.992}, {4, 0.914, 0.976}, {3, 0.858, 0.866}, {3, 0.884, 0.956}};
  int points = 0;
  std::size_t least = 20;
  for (const auto& [xs, from, to] : windows)
    for (int i = static_cast<int>(std::round(from * 500)); i <= static_cast<int>(std::round(to * 500)); ++i) {
      Problem scene = sweep::paper_scene(xs, i / 500.0);
      scene.observe.impact_log = true;
      scene.time.mode = steady::Mode::transient, scene.time.duration = 400;
      const PointResult all = result_of(scene, true), found = result_of(scene, false);
      const std::size_t count = std::min<std::size_t>(20, all.log.size());
      ASSERT_GE(found.log.size(), count);
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_EQ(found.log[k].stop, all.log[k].stop);
        EXPECT_NEAR(found.log[k].time / all.log[k].time, 1, 1e-12);
        EXPECT_NEAR(found.log[k].before / all.log[k].before, 1, 1e-12);
      }
      least = std::min(least, count), ++points;
    }
  EXPECT_EQ(points, 81);
  EXPECT_GE(least, 10u);  // Fig. 21 hits its stops rarely
}

/// Forced motion between stops, of all kinds.
Problem any_steady(std::uint64_t i) {
  support::Random random(77, i);
  Problem scene = figure(1, random.logarithmic(0.3, 3));
  const double h = random.logarithmic(0.02, 2), f = random.sign() * random.logarithmic(0.1, 3);
  scene.oscillator = {h, f, scene.oscillator.frequency, random.happens(0.5) ? 0 : random.uniform(-1, 1)};
  const double lower = random.logarithmic(0.05, 5), upper = random.logarithmic(0.05, 5);
  scene.stops = {-lower, upper, random.uniform(0, 1), random.uniform(0, 1)};
  scene.start = {random.uniform(-lower, upper), random.uniform(-1, 1), random.uniform(0, 2 * std::numbers::pi)};
  scene.time.max_periods = 600;
  return scene;
}

/// A rest forgets all changes, but many periods without one may have multiplied them by more than 1/epsilon before the
/// next: then rounding chooses between long periods, all of which begin with a rest.
bool chaotic_between_rests(const PointResult& result) { return result.period_ratio > 8 && std::isinf(result.lyapunov); }

TEST(Steady, motion_that_nobody_chose_is_that_of_a_long_run) {
  int points = 0, newton = 0, closed = 0, missed = 0, scenes = 600;
  double worst = 0, periods = 0;
  for (int i = 0; i < scenes; ++i) {
    const Problem scene = any_steady(static_cast<std::uint64_t>(i));
    const PointResult found = result_of(scene, false), all = result_of(scene, true);
    ASSERT_FALSE(failed(found.status)) << i;
    missed += found.status == steady::Status::periodic &&
              all.status == steady::Status::aperiodic;  // settles more slowly than it ran
    if (all.status != steady::Status::periodic || chaotic_between_rests(all)) continue;
    ASSERT_EQ(found.status, steady::Status::periodic) << i << "\n" << support::configuration_of(scene, 0);
    EXPECT_TRUE(same_period(found, all)) << i << ": " << found.period_ratio << " against " << all.period_ratio << "\n"
                                         << support::configuration_of(scene, 0);
    const double left = 1 - std::exp(found.lyapunov * found.period);
    // either is known to the tolerance of its states over what a period leaves of a change
    const double d = difference(found, all) / (4e-12 / std::max(1e-6, std::min(1.0, left)));
    EXPECT_LE(d, 1) << i << " found by " << steady::found_by_names[static_cast<std::size_t>(found.found_by)] << "\n"
                    << support::configuration_of(scene, 0);
    worst = std::max(worst, d), ++points, periods += found.periods;
    newton += found.found_by == steady::FoundBy::newton, closed += found.found_by == steady::FoundBy::closed_form;
  }
  std::cout << points << " periodic of " << scenes << " scenes, " << newton << " by Newton's method, " << closed
            << " in closed form, " << periods / points << " periods each; " << missed
            << " that a long run had not settled to; at most " << worst << " of what is allowed\n";
  EXPECT_GT(points, scenes * 3 / 4);
  EXPECT_GT(newton, scenes / 20);
  EXPECT_GT(closed, scenes / 20);
  EXPECT_LT(missed, scenes / 20);
}

TEST(Steady, free_motion_that_nobody_chose_is_that_of_a_long_run) {
  int points = 0, energy = 0, stands = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    support::Random random(78, i);
    Problem scene = any_steady(i);
    scene.oscillator.forcing = 0, scene.oscillator.damping = random.happens(0.5) ? 0 : scene.oscillator.damping;
    if (random.happens(0.5)) scene.stops.restitution_lower = scene.stops.restitution_upper = 1;
    scene.time.max_periods = 200, scene.time.max_impacts = 1e4;  // a pressed mass that loses nothing hardly flies
    const PointResult found = result_of(scene, false), all = result_of(scene, true);
    if (all.status != steady::Status::periodic || found.status != steady::Status::periodic) continue;
    ++points;
    energy += found.found_by == steady::FoundBy::energy;
    stands += found.found_by == steady::FoundBy::standstill;
    EXPECT_EQ(found.found_by == steady::FoundBy::standstill, all.found_by == steady::FoundBy::standstill)
        << support::configuration_of(scene, 0);
    if (all.found_by == steady::FoundBy::standstill) {
      EXPECT_NEAR(found.x_max, all.x_max, 1e-11) << support::configuration_of(scene, 0);
      continue;
    }
    // 200 turns, with an ulp of each impact's time and of a section
    EXPECT_NEAR(found.period / all.period, 1, 1e-9) << i << "\n" << support::configuration_of(scene, 0);
    EXPECT_LE(difference(found, all), 1e-9) << i << "\n" << support::configuration_of(scene, 0);
  }
  std::cout << points << " periodic points: " << energy << " by energy, " << stands << " stand still\n";
  EXPECT_GT(energy, 50);
  EXPECT_GT(stands, 50);
}

}  // namespace
}  // namespace clatter::point::steady_test
