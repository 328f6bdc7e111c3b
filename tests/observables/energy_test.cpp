#include "observables/energy/energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "point/point.hpp"
#include "scene/response.hpp"
#include "support/random.hpp"

namespace clatter::observables::energy_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), pi_ = std::numbers::pi;

point::Problem scene_of(const Oscillator& oscillator, const Stops& stops) {
  point::Problem scene;
  scene.oscillator = oscillator, scene.stops = stops;
  scene.observe.energy = true;
  return scene;
}

point::PointResult result_of(const point::Problem& scene) {
  point::ThreadScratch scratch{Harmonics::scratch_for(scene.observe)};
  return run_point(scene, scratch);
}

double largest_term(const point::PointResult& r) {
  return std::max({std::abs(r.work_in), r.loss_damping, r.loss_impact[0], r.loss_impact[1]});
}

TEST(Energy, of_the_response_goes_into_damping_alone) {
  // x = P sin + Q cos: the force does -pi f Q = 2 pi h nu A^2 in a period
  for (const double nu : {0.3, 0.9, 1.0, 1.7, 6.0}) {
    const Oscillator o{0.1, -1.5, nu, 0.4};
    const point::PointResult r = result_of(scene_of(o, {-infinity, infinity, 1, 1}));
    const double work = 2 * pi_ * o.damping * nu * std::pow(steady_response(o.damping, o.forcing, nu).amplitude, 2);
    EXPECT_NEAR(r.work_in, work, 1e-13 * work) << nu;
    EXPECT_NEAR(r.loss_damping, work, 1e-13 * work) << nu;
    EXPECT_EQ(r.loss_impact[0] + r.loss_impact[1] + r.impulse[0] + r.impulse[1] + r.impact_power, 0) << nu;
  }
}

TEST(Energy, of_the_symmetric_motion_is_that_of_its_closed_form) {
  // eq. 37: one impact a period on each stop, at the speed u
  constexpr double near = 2e-14;  // Newton's method finds the period to some ten ulps, the impacts lie a few behind it
  const double u = 0.88861376168497155, R = 0.7, loss = (1 - R * R) * u * u / 2;
  const point::PointResult r = result_of(scene_of({0.1, -1.0, 1.0, 0.0}, {-0.5, 0.5, R, R}));
  for (const std::size_t stop : {0U, 1U}) {
    EXPECT_NEAR(r.loss_impact[stop], loss, near) << stop;
    EXPECT_NEAR(r.impulse[stop], (1 + R) * u, near) << stop;
  }
  EXPECT_NEAR(r.impact_power, loss / pi_, near);
  EXPECT_LE(std::abs(r.energy_residual), 1e-13 * largest_term(r));
}

/// The fast mode of heavy damping is gone at once; that takes the logarithm of its rate, not its rate.
TEST(Energy, of_heavy_damping_closes_at_a_cost_that_hardly_grows_with_it) {
  for (const bool is_loose : {false, true})
    for (const double h : {3.0, 30.0, 1e3, 1e5, 1e7}) {
      point::Problem scene = scene_of({h, 1.0, 1.1, 0.2}, {-0.8, 0.5, 0.6, 0.6});
      scene.start.velocity = h, scene.start.phase = 1;  // it gets as far as 1/2 before it is slow
      scene.observe.wall_energy = is_loose;
      if (is_loose) scene.loose = {.ratio = 0.2, .lower = -0.3, .upper = 0.3, .place = 0.1, .velocity = 2.0};
      scene.time.mode = steady::Mode::transient, scene.time.duration = 30;
      const point::PointResult r = result_of(scene);
      EXPECT_LE(std::abs(r.energy_residual), 1e-13 * std::max(largest_term(r), h * h / 2)) << h;
      EXPECT_GT(r.loss_damping, 0.4 * h * h) << h;
      EXPECT_LT(r.evaluations, 20000) << h;
    }
}

TEST(Energy, is_kept_by_conservative_motion) {
  point::Problem scene = scene_of({0.0, 0.0, 1.0, 0.0}, {-0.75, 0.75, 1, 1});
  scene.start.velocity = -1.0;
  const point::PointResult r = result_of(scene);
  EXPECT_EQ(r.work_in, 0);
  EXPECT_EQ(r.loss_damping, 0);
  EXPECT_EQ(r.loss_impact[0] + r.loss_impact[1], 0);
  const double speed = std::sqrt(1 - 0.75 * 0.75);
  for (const std::size_t stop : {0U, 1U}) EXPECT_NEAR(r.impulse[stop], 2 * speed, 4e-16) << stop;
  EXPECT_LE(std::abs(r.energy_residual), 1e-15);
}

TEST(Energy, of_a_mass_that_comes_to_rest_is_lost_to_the_last_bounce) {
  // without damping and force, pressed onto the upper stop: a chatter, completed by its sum, then rest
  point::Problem scene = scene_of({0.0, 0.0, 1.0, 2.0}, {-infinity, 0.5, 0.7, 0.7});
  scene.time.mode = steady::Mode::transient, scene.time.duration = 20;
  scene.start.displacement = 0.3;
  const point::PointResult r = result_of(scene);
  const double work = 2.0 * (0.5 - 0.3), growth = (0.5 * 0.5 - 0.3 * 0.3) / 2;
  EXPECT_NEAR(r.work_in, work, 1e-16);
  EXPECT_NEAR(r.loss_impact[1], work - growth, 1e-15);
  EXPECT_LE(std::abs(r.energy_residual), 1e-15);
}

TEST(Energy, impulses_balance_the_mean_of_the_other_forces) {
  // over a period the momentum is the same again: J_upper - J_lower = T (load - mean x), rest and chatter included
  int resting = 0;
  for (const double R : {0.0, 0.5, 0.7})
    for (const double load : {-0.2, 0.0, 0.3}) {
      point::Problem scene = scene_of({0.1, 1.0, 0.5, load}, {-0.5, 0.4, R, R});
      scene.observe.harmonics = 1, scene.observe.harmonics_method = HarmonicsMethod::exact;
      scene.observe.impacts = true;
      const point::PointResult r = result_of(scene);
      ASSERT_EQ(r.status, steady::Status::periodic) << R << ' ' << load;
      resting += r.rest_fraction[0] + r.rest_fraction[1] > 0 ? 1 : 0;
      const double period = r.observed_turns * period_of(scene.oscillator);
      EXPECT_NEAR(r.impulse[1] - r.impulse[0], period * (load - r.x_spectrum.amplitude[0]), 1e-13 * period)
          << R << ' ' << load;
    }
  EXPECT_GT(resting, 5);
}

TEST(Energy, closes_its_books_on_periodic_motion_of_every_kind) {
  int impacts = 0, periodic = 0;
  double worst = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    support::Random random(31, index);
    const double gap = random.logarithmic(0.05, 3);
    point::Problem scene = scene_of({random.happens(0.2) ? random.uniform(1, 3) : random.logarithmic(0.02, 0.9), 1.0,
                                     random.logarithmic(0.2, 5), random.uniform(-0.3, 0.3)},
                                    {-gap, gap * random.uniform(0.5, 1.5), random.uniform(0, 1), random.uniform(0, 1)});
    scene.time.max_periods = 500;
    const point::PointResult r = result_of(scene);
    if (r.status != steady::Status::periodic) continue;
    ++periodic, impacts += r.loss_impact[0] + r.loss_impact[1] > 0 ? 1 : 0;
    worst = std::max(worst, std::abs(r.energy_residual) / largest_term(r));
  }
  EXPECT_LE(worst, 1e-13);
  EXPECT_GT(periodic, 150);
  EXPECT_GT(impacts, 80);
}

TEST(Energy, shows_the_energy_error_of_time_stepping) {
  // Moreau's residual goes down with the step; the exact method's is rounding
  point::Problem scene = scene_of({0.1, -1.0, 1.0, 0.0}, {-0.5, 0.5, 0.7, 0.7});
  scene.time.mode = steady::Mode::transient, scene.time.duration = 20;
  EXPECT_LE(std::abs(result_of(scene).energy_residual), 1e-14);
  scene.integration.method = stepping::Method::moreau;
  double coarse = 0, fine = 0;
  for (int i = 0; i < 8; ++i) {  // the mean over steps nearby: how a step meets an impact is accidental
    scene.integration.step = 1.0 / (200 + i), coarse += std::abs(result_of(scene).energy_residual) / 8;
    scene.integration.step = 1.0 / (3200 + i), fine += std::abs(result_of(scene).energy_residual) / 8;
  }
  EXPECT_GT(coarse, 1e-5);
  EXPECT_LT(fine, coarse / 4);
}

}  // namespace
}  // namespace clatter::observables::energy_test
