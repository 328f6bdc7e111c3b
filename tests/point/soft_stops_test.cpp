// What is observed of motion between soft stops, against closed forms, samples, differences and a general solver.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "point/point.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"
#include "support/soft_scene.hpp"

namespace clatter::point::soft_stops_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

PointResult run(const Problem& scene) {
  ThreadScratch scratch{.fourier = observables::Harmonics::scratch_for(scene.observe)};
  return run_point(scene, scratch);
}

/// Stops at -g and g, everything observed that impacts and energy are about.
Problem between_soft(const Oscillator& oscillator, double g, double kappa, double zeta) {
  Problem scene = support::scene_of(oscillator, -g, g, 1.0);
  scene.stops.stiffness_lower = scene.stops.stiffness_upper = kappa;
  scene.stops.damping_lower = scene.stops.damping_upper = zeta;
  scene.observe.extrema = scene.observe.impacts = scene.observe.of_soft_stops = true;
  scene.observe.period = scene.observe.energy = true;
  return scene;
}

TEST(SoftStops, energy_closes_over_any_time) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    Problem scene = support::soft_scene(i);
    scene.observe.energy = scene.observe.extrema = true;
    const PointResult found = run(scene);
    ASSERT_FALSE(failed(found.status)) << i;
    const double fastest = std::max(std::abs(found.v_min), std::abs(found.v_max));
    const double size =
        found.loss_damping + std::abs(found.work_in) + found.loss_impact[0] + found.loss_impact[1] + fastest * fastest;
    EXPECT_LT(std::abs(found.energy_residual), 1e-12 * size) << i;  // some thousand terms, each to rounding
    EXPECT_GE(found.loss_impact[0], -1e-14 * size) << i;
    EXPECT_GE(found.loss_impact[1], -1e-14 * size) << i;
  }
}

/// A contact may be renewed beyond the stop's position; its impact ends where the stop's force first falls to 0.
TEST(SoftStops, the_log_has_the_separation_that_follows_each_touch) {
  std::size_t renewed = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Problem scene = support::soft_scene(i);
    if (is_soft(scene.stops, Side::lower) != is_soft(scene.stops, Side::upper)) continue;
    scene.observe.impact_log = true;
    const PointResult found = run(scene);
    const support::Recorder seen = support::run_scene(scene, scene.time.duration).record;
    std::vector<double> after;
    for (std::size_t k = 0; k < seen.touches.size(); ++k) {
      const motion::Event& touch = seen.touches[k];
      renewed += touch.kind != motion::Event::Kind::touch;
      if (touch.kind != motion::Event::Kind::touch || !(touch.time > 0)) continue;
      const auto next = std::ranges::find_if(seen.separations, [&](const motion::Event& separation) {
        return separation.side == touch.side && separation.time >= touch.time;
      });
      after.push_back(next == seen.separations.end() ? std::numeric_limits<double>::quiet_NaN() : next->after);
    }
    ASSERT_EQ(found.log.size(), after.size()) << i;
    for (std::size_t k = 0; k < after.size(); ++k)
      EXPECT_TRUE(found.log[k].after == after[k] || (std::isnan(found.log[k].after) && std::isnan(after[k])))
          << i << ' ' << k << ": " << found.log[k].after << ' ' << after[k];
  }
  EXPECT_GT(renewed, 20);
}

TEST(SoftStops, free_motion_has_the_period_of_eq_56_and_the_depth_of_its_energy) {
  for (const double kappa : {3.0, 1e5})
    for (const double V : {1.5, 4.0}) {
      Problem scene = between_soft({}, 1.0, kappa, 0.0);
      scene.start.velocity = V;
      const PointResult found = run(scene);
      const double stiff = std::sqrt(1 + kappa), far = std::sqrt(V * V - 1);
      ASSERT_EQ(found.status, steady::Status::periodic);
      EXPECT_EQ(found.found_by, steady::FoundBy::repetition);
      EXPECT_NEAR(found.period, 4 * (std::asin(1 / V) + std::atan(stiff * far) / stiff), 1e-13);
      const double depth = (std::sqrt(1 + (1 + kappa) * far * far) - 1) / (1 + kappa);  // (x^2 + kappa d^2 = V^2)
      EXPECT_NEAR(found.x_max, 1 + depth, 1e-14 * (1 + depth));
      EXPECT_NEAR(found.contact_force_max[1], kappa * depth, 1e-11 * kappa * depth);
      EXPECT_NEAR(found.v_before[1], far, 1e-14 * V * V / far);
      EXPECT_NEAR(found.v_after[1], -far, 1e-14 * V * V / far);
      EXPECT_EQ(found.impact_speed[1], found.v_before[1]);
      const double contact = std::numbers::pi - 2 * std::atan(1 / (stiff * far));
      EXPECT_NEAR(found.contact_fraction[1], contact / stiff / found.period, 1e-12);
    }
}

/// The stop's force is then the load, for the period of a spring that is a million times weaker than that of the stop.
TEST(SoftStops, a_mass_that_leans_on_one_has_its_ledger_at_once) {
  Problem scene = between_soft({1e-5, 0.0, 0.55, 2.25}, 0.25, 28000.0, 1.2);
  scene.oscillator.stiffness = 1e-12;
  scene.start.displacement = 0.25;
  scene.observe.energy = true;
  const PointResult found = run(scene);
  EXPECT_EQ(found.work_in, 0);
  EXPECT_NEAR(found.impulse[1] / (2.25 * period_of(scene.oscillator)), 1, 1e-9);
  EXPECT_EQ(found.impulse[0], 0);
}

TEST(SoftStops, forced_motion_is_that_of_a_dense_scan) {
  for (const double zeta : {0.0, 0.3, 2.0}) {
    Problem scene = between_soft({0.3, -1.0, 1.0, 0.05}, 0.3, 40.0, zeta);
    scene.observe.trajectory = 400001;
    const PointResult found = run(scene);
    ASSERT_EQ(found.status, steady::Status::periodic);
    double highest = -infinity, in_contact = 0, force = 0;
    for (std::size_t i = 0; i + 1 < found.x.size(); ++i) {
      highest = std::max(highest, found.x[i]);
      const double depth = found.x[i] - 0.3, push = 40 * depth + 2 * zeta * std::sqrt(40) * found.v[i];
      if (depth > 0 && push > 0) in_contact += 1, force = std::max(force, push);
    }
    const double step = found.period / 400000;
    EXPECT_NEAR(found.x_max, highest, 40 * step * step);  // the scan misses a turn by half a step at most
    EXPECT_NEAR(found.contact_fraction[1], in_contact / 400000,
                12.0 / 400000);  // a sample at each end of some contacts
    const double slope =
        40 * found.v_max + 2 * zeta * std::sqrt(40.0) * 40;  // of the force, where it jumps at the touch
    EXPECT_NEAR(found.contact_force_max[1], force, slope * step);
    EXPECT_LE(force, found.contact_force_max[1] * (1 + 1e-12));
    EXPECT_GT(found.impacts_per_period[1], 0);
    EXPECT_LT(found.v_after[1], 0);
  }
}

TEST(SoftStops, exact_harmonics_are_those_of_samples) {
  Problem scene = between_soft({0.1, -1.0, 1.0, 0.05}, 0.5, 400.0, 0.2);
  scene.observe.harmonics = 5, scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
  const PointResult exact = run(scene);
  scene.observe.harmonics_method = observables::HarmonicsMethod::fft, scene.observe.harmonics_samples = 1 << 18;
  const PointResult sampled = run(scene);
  for (std::size_t k = 0; k <= 5; ++k) {
    // the acceleration jumps, so aliases fall as the square of the number of samples
    EXPECT_NEAR(exact.x_spectrum.amplitude[k], sampled.x_spectrum.amplitude[k], 1e-9) << k;
    EXPECT_NEAR(exact.v_spectrum.amplitude[k], sampled.v_spectrum.amplitude[k], 1e-9) << k;
  }
}

TEST(SoftStops, multipliers_are_those_of_differences) {
  for (const double zeta : {0.0, 0.4, 1.5}) {
    Problem scene = between_soft({0.3, -1.0, 1.0, 0.05}, 0.3, 40.0, zeta);
    scene.observe.stability = true;
    const PointResult found = run(scene);
    ASSERT_EQ(found.status, steady::Status::periodic);
    const double period = found.period, small = 1e-5;
    const auto end = [&](double x, double v) {
      Problem moved = scene;
      moved.start = {found.end.displacement + x, found.end.velocity + v, found.end.phase};
      return support::run_scene(moved, period).end;
    };
    const auto right = end(small, 0), left = end(-small, 0), up = end(0, small), down = end(0, -small);
    const double a = (right.x - left.x) / (2 * small), c = (right.v - left.v) / (2 * small),
                 b = (up.x - down.x) / (2 * small), d = (up.v - down.v) / (2 * small);
    const auto& re = found.multiplier_re;
    const auto& im = found.multiplier_im;
    EXPECT_NEAR(re[0] + re[1], a + d, 1e-7);  // third derivatives of the map times the square of the step
    EXPECT_NEAR(re[0] * re[1] - im[0] * im[1], a * d - b * c, 1e-7);
  }
}

TEST(SoftStops, a_load_presses_the_mass_to_rest_in_the_stop) {
  for (const double zeta : {0.0, 0.2, 3.0})
    for (const double h : {0.0, 0.1}) {
      if (h == 0 && zeta == 0) continue;  // it never comes to rest
      Problem scene = between_soft({h, 0.0, 1.0, 2.0}, 1.0, 9.0, zeta);
      const PointResult found = run(scene);
      ASSERT_EQ(found.status, steady::Status::periodic) << h << ' ' << zeta;
      EXPECT_EQ(found.found_by, steady::FoundBy::standstill);
      EXPECT_NEAR(found.x_max, (2.0 + 9.0) / 10.0, 1e-11);  // of the settling's tolerance
      EXPECT_NEAR(found.contact_fraction[1], 1, 1e-15);
    }
}

/// A mass that a stop always pushes is a linear oscillator, with the spring and the damper of both.
TEST(SoftStops, motion_that_is_always_pressed_is_the_response_of_spring_and_stop) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    support::Random random(4112, i);
    const double kappa = random.logarithmic(1, 1e8), zeta = random.logarithmic(1e-3, 2), h = random.uniform(0, 0.5);
    const double f = random.uniform(0.2, 1.2), nu = random.uniform(0.3, 2.8), side = random.sign();
    const double damping = h + zeta * std::sqrt(kappa), dynamic = 1 + kappa - nu * nu, friction = 2 * damping * nu;
    const double squares = dynamic * dynamic + friction * friction, amplitude = f / std::sqrt(squares);
    // a load that presses 1.1 times as much as the force takes away
    const double balance = 1.1 * amplitude * std::hypot(1.0, 2 * zeta * nu / std::sqrt(kappa));
    Problem scene = support::scene_of({h, f, nu, side * (0.7 + (1 + kappa) * balance)}, -0.7, 0.7, 1.0);
    scene.stops.stiffness_lower = scene.stops.stiffness_upper = kappa;
    scene.stops.damping_lower = scene.stops.damping_upper = zeta;
    // near the steady motion, as there may be others
    const double away = random.uniform(0.98, 1.02);
    scene.start = {side * (0.7 + balance) - away * f * friction / squares, away * nu * f * dynamic / squares, 0.0};
    scene.time.max_periods = 100'000;
    scene.observe.extrema = scene.observe.energy = true;
    const PointResult found = run(scene);
    ASSERT_EQ(found.status, steady::Status::periodic) << i;
    EXPECT_EQ(found.observed_turns, 1) << i;
    // rounding of the displacement rings at the natural frequency of mass and stop
    const double ringing = 8 * epsilon<double>() * std::sqrt(1 + kappa) / nu, rounding = 1e-13 + ringing;
    EXPECT_NEAR(found.v_max, nu * amplitude, rounding * nu * amplitude) << i << ' ' << kappa;
    EXPECT_NEAR(found.v_min, -nu * amplitude, rounding * nu * amplitude) << i << ' ' << kappa;
    const double work = std::numbers::pi * f * f * friction / squares;
    EXPECT_NEAR(found.work_in, work, 10 * rounding * std::numbers::pi * f * amplitude) << i << ' ' << kappa;
    EXPECT_NEAR(found.x_max - found.x_min, 2 * amplitude, 1e-12 * amplitude + 4e-16) << i << ' ' << kappa;
  }
}

TEST(SoftStops, undamped_motion_that_stays_in_contact_has_the_period_of_both_springs) {
  Problem scene = between_soft({0.0, 0.0, 1.0, 2.0}, 1.0, 9.0, 0.0);
  scene.start = {1.12, 0.05, 0.0};
  const PointResult found = run(scene);
  ASSERT_EQ(found.status, steady::Status::periodic);
  EXPECT_NEAR(found.period, 2 * std::numbers::pi / std::sqrt(10.0), 1e-14);
  EXPECT_NEAR(found.x_max, 1.1 + std::hypot(0.02, 0.05 / std::sqrt(10.0)), 1e-15);
}

TEST(SoftStops, a_general_solver_finds_the_same) {
  Problem scene = between_soft({0.3, -1.0, 1.0, 0.05}, 0.3, 40.0, 0.3);
  scene.observe.stability = true;
  const PointResult exact = run(scene);
  scene.integration.method = stepping::Method::dopri5, scene.integration.tolerance = 1e-12;
  scene.time.tolerance = 1e-10;
  const PointResult solved = run(scene);
  ASSERT_EQ(solved.status, steady::Status::periodic);
  const double error = 1e-8;  // some thousand steps of 1e-12, through multipliers near 1
  EXPECT_NEAR(solved.x_max, exact.x_max, error);
  EXPECT_NEAR(solved.contact_force_max[1], exact.contact_force_max[1], 100 * error);
  EXPECT_NEAR(solved.contact_fraction[1], exact.contact_fraction[1], error);
  EXPECT_NEAR(solved.loss_impact[1], exact.loss_impact[1], error);
  EXPECT_NEAR(solved.multiplier_re[0], exact.multiplier_re[0], 1e-6);
}

TEST(SoftStops, motion_that_newtons_method_finds_is_that_of_a_long_run) {
  int newton = 0, compared = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Problem scene = support::soft_scene(i);
    if (scene.oscillator.forcing == 0) continue;
    scene.time = {.max_periods = 1500};
    scene.observe.extrema = scene.observe.period = scene.observe.stability = true;
    const PointResult found = run(scene);
    if (found.found_by != steady::FoundBy::newton) continue;
    ++newton;
    EXPECT_LT(std::hypot(found.multiplier_re[0], found.multiplier_im[0]), 1) << i;
    scene.integration.all_effects = true;
    const PointResult all = run(scene);
    if (all.status != steady::Status::periodic) continue;  // it settles more slowly than it ran
    ++compared;
    EXPECT_EQ(found.period_ratio, all.period_ratio) << i;
    // either is known to the tolerance of its states over what a period leaves of a change
    const double left = 1 - std::exp(found.lyapunov * found.period), size = std::max(found.v_max, -found.v_min);
    const double allowed = 4e-12 / std::max(1e-6, std::min(1.0, left)) * std::max(size, std::abs(found.x_max));
    EXPECT_NEAR(found.x_min, all.x_min, allowed) << i;
    EXPECT_NEAR(found.x_max, all.x_max, allowed) << i;
    EXPECT_NEAR(found.v_min, all.v_min, allowed) << i;
    EXPECT_NEAR(found.v_max, all.v_max, allowed) << i;
  }
  EXPECT_GT(newton, 30);
  EXPECT_GT(compared, newton / 2);
}

TEST(SoftStops, out_of_reach_cost_nothing) {
  Problem scene = between_soft({0.1, -1.0, 1.5, 0.0}, 3.0, 40.0, 0.3), without = scene;
  without.stops = Stops{};
  EXPECT_FALSE(effects_of(scene).soft);
  EXPECT_EQ(effect_set_of(effects_of(scene)), effect_set_of(effects_of(without)));
  EXPECT_EQ(run(scene).x_max, run(without).x_max);
}

}  // namespace
}  // namespace clatter::point::soft_stops_test
