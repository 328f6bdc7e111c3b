#include "sweep/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>

#include "point/point.hpp"
#include "support/soft_scene.hpp"
#include "sweep/figures.hpp"

namespace clatter::sweep::run_test {
namespace {

TEST(Run, gives_the_same_bits_for_every_number_of_threads) {
  point::Problem scene = paper_scene(3.0, 1.0);
  scene.time.max_periods = 400;  // some points stay aperiodic
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.harmonics = 2;
  scene.observe.harmonics_samples = 257;
  scene.observe.impacts = true;
  scene.observe.impact_log = true;
  scene.observe.trajectory = 5;
  scene.observe.period = true;
  Axis nu{Parameter("nu"), {}};
  for (int i = 0; i < 40; ++i) nu.values.push_back(0.8 + 0.01 * i);
  const Sweep sweep = sweep_of(scene, {nu, {Parameter("R"), {0.5, 0.7}}});
  const results::Dataset one = run(sweep, {.threads = 1}).dataset;
  for (int threads : {2, 3, 8}) expect_same(one, run(sweep, {.threads = threads}).dataset);
  const auto status = statuses(one);
  EXPECT_GT(std::count(status.begin(), status.end(), 0), 0);
  EXPECT_GT(std::count(status.begin(), status.end(), 1), 0);
}

TEST(Run, stores_nothing_that_is_not_observed) {
  const results::Dataset figure = run(sweep_of(paper_scene(0.5, 1.0), {}), {.threads = 1}).dataset;
  std::vector<std::string> names;
  for (const results::Variable& variable : figure.variables) names.push_back(variable.name);
  EXPECT_EQ(names, (std::vector<std::string>{"status", "impact_total", "simulated_periods", "settling_estimate"}));
}

TEST(Run, points_stand_at_their_index_in_every_order_of_axes) {
  point::Problem scene = paper_scene(6.0, 1.0);
  scene.observe.extrema = true;
  const Axis nu{Parameter("nu"), {0.6, 0.9, 1.4}}, f{Parameter("f"), {1.0, 2.0}};
  const results::Dataset a = run(sweep_of(scene, {nu, f}), {}).dataset, b = run(sweep_of(scene, {f, nu}), {}).dataset;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(values(a, "x_max")[i * 2 + j], values(b, "x_max")[j * 3 + i]);
}

TEST(Run, follow_starts_where_the_point_before_ended_with_its_phase) {
  // a transient of two equal points, one after the other, is one transient of twice the length
  point::Problem scene = paper_scene(0.5, 1.3);
  scene.start = {0.1, 0.2, 0.4};
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = 7.7;  // no whole number of periods: the phase has to come along
  scene.observe.trajectory = 12;
  Sweep halves = sweep_of(scene, {{Parameter("R"), {0.7, 0.7}}});
  halves.follow = 0;
  scene.time.duration *= 2;
  scene.observe.trajectory = 23;
  const results::Dataset two = run(halves, {}).dataset, whole = run(sweep_of(scene, {}), {}).dataset;
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(values(two, "x")[i], values(whole, "x")[i], 1e-13);
    EXPECT_NEAR(values(two, "x")[12 + i], values(whole, "x")[11 + i], 1e-13);
    EXPECT_NEAR(values(two, "v")[12 + i], values(whole, "v")[11 + i], 1e-12);
  }
}

/// Between soft stops a period may be cut while the mass is beyond the position of one, or in contact with it.
TEST(Run, follow_goes_on_from_within_a_soft_stop) {
  std::size_t within = 0;
  for (std::uint64_t index = 0; index < 150; ++index) {
    point::Problem scene = support::soft_scene(index);
    scene.observe.trajectory = 2;
    Sweep halves = sweep_of(scene, {{Parameter("f"), {scene.oscillator.forcing, scene.oscillator.forcing}}});
    halves.follow = 0;
    scene.time.duration *= 2;
    const results::Dataset two = run(halves, {}).dataset, whole = run(sweep_of(scene, {}), {}).dataset;
    const double x = values(two, "x")[1], speed = std::abs(values(whole, "v")[1]);
    within += x < scene.stops.lower || x > scene.stops.upper;
    EXPECT_EQ(values(two, "x")[2], x) << index;
    // an ulp of x in a stiff stop is the root of its stiffness times an ulp of v, and impacts in between stretch it
    EXPECT_NEAR(values(two, "x")[3], values(whole, "x")[1], 1e-9) << index;
    EXPECT_NEAR(values(two, "v")[3], values(whole, "v")[1], 1e-8 * (1 + speed)) << index;
  }
  EXPECT_GT(within, 20);
}

TEST(Run, follow_stays_on_its_branch_upwards_and_downwards) {
  // stops that the linear resonance reaches: between the two folds the branch depends on where one comes from
  point::Problem scene = paper_scene(3.0, 1.0);
  scene.stops.restitution_lower = scene.stops.restitution_upper = 0.95;
  scene.observe.extrema = scene.observe.impacts = true;
  Axis up{Parameter("nu"), {}};
  for (int i = 0; i <= 120; ++i) up.values.push_back(1.0 + 0.01 * i);
  Axis down = up;
  std::reverse(down.values.begin(), down.values.end());
  Sweep a = sweep_of(scene, {up}), b = sweep_of(scene, {down});
  a.follow = b.follow = 0;
  const results::Dataset rising = run(a, {}).dataset, falling = run(b, {}).dataset;
  const std::size_t n = up.values.size();
  std::size_t apart = 0;
  for (std::size_t i = 0; i < n; ++i)
    apart += std::abs(values(rising, "x_max")[i] - values(falling, "x_max")[n - 1 - i]) > 0.1;
  EXPECT_GT(apart, 5u);
  EXPECT_EQ(values(rising, "x_max")[0], 3.0);      // both hit the stops at resonance
  EXPECT_LT(values(rising, "x_max")[n - 1], 1.0);  // and neither far above it
  EXPECT_LT(values(falling, "x_max")[0], 1.0);
}

TEST(Run, follow_downwards_and_both_ways_is_that_along_the_values_in_their_order) {
  point::Problem scene = paper_scene(4.0, 1.0);  // two branches between folds
  scene.observe.extrema = true, scene.observe.section = 1;
  const Axis R{Parameter("R"), {0.6, 0.7}};
  Axis nu{Parameter("nu"), {}};
  for (int i = 0; i <= 50; ++i) nu.values.push_back(0.8 + 0.01 * i);
  Axis there_and_back = nu;
  there_and_back.values.insert(there_and_back.values.end(), nu.values.rbegin(), nu.values.rend());
  const auto followed = [&](const Axis& axis, Direction direction) {
    Sweep sweep = sweep_of(scene, {R, axis});
    sweep.follow = 1, sweep.direction = direction;
    return run(sweep, {.threads = 2}).dataset;
  };
  const results::Dataset wanted = followed(there_and_back, Direction::up), both = followed(nu, Direction::both);
  Axis falling = nu;
  std::ranges::reverse(falling.values);
  const results::Dataset down = followed(nu, Direction::down), reversed = followed(falling, Direction::up);
  ASSERT_EQ(find(both, "x_max")->dimensions, (std::vector<std::string>{"direction", "R", "nu"}));
  EXPECT_EQ(std::get<std::vector<std::int8_t>>(find(both, "direction")->values), (std::vector<std::int8_t>{1, -1}));
  const std::size_t n = nu.values.size();
  std::size_t apart = 0;
  for (const char* name : {"x_max", "section_v"})
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t i = 0; i < n; ++i) {
        const double up = values(both, name)[r * n + i], back = values(both, name)[(2 + r) * n + i];
        EXPECT_EQ(up, values(wanted, name)[2 * r * n + i]);
        EXPECT_EQ(back, values(wanted, name)[2 * r * n + 2 * n - 1 - i]);
        EXPECT_EQ(values(down, name)[r * n + i], values(reversed, name)[r * n + n - 1 - i]);
        apart += std::abs(up - back) > 0.1;
      }
  EXPECT_GT(apart, 4u);
}

TEST(Run, follow_moves_a_state_outside_narrower_stops_onto_the_stop) {
  point::Problem scene = paper_scene(3.0, 1.0);
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = 30.0;
  scene.observe.extrema = true;
  scene.observe.trajectory = 2;
  Sweep sweep = sweep_of(scene, {{Parameter("xs"), {3.0, 0.01}}});
  sweep.follow = 0;
  const results::Dataset figure = run(sweep, {}).dataset;
  EXPECT_EQ(std::abs(values(figure, "x")[2]), 0.01);
  ASSERT_GT(values(figure, "v")[1] * values(figure, "x")[2], 0.0);  // it moves into the stop,
  EXPECT_DOUBLE_EQ(values(figure, "v")[2],
                   -0.7 * values(figure, "v")[1]);  // with the velocity it had, and is reversed at once
  EXPECT_LE(values(figure, "x_max")[1], 0.01);
}

TEST(Run, a_failed_point_has_no_values_and_does_not_lead_the_next_astray) {
  point::Problem scene = paper_scene(0.5, 1.0);
  scene.time.max_impacts = 40;
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.impacts = true;
  scene.observe.impact_log = true;
  scene.observe.trajectory = 3;
  scene.observe.period = true;
  Sweep sweep = sweep_of(scene, {{Parameter("xs"), {0.01, 6.0}}});
  sweep.follow = 0;
  const RunResult result = run(sweep, {});
  EXPECT_EQ(statuses(result.dataset), (std::vector<std::uint8_t>{16, 0}));
  EXPECT_EQ(result.statuses.failed(), 1u);
  for (const char* name : {"x_min", "x_max", "v_min", "v_max", "period", "period_ratio"}) {
    EXPECT_TRUE(std::isnan(values(result.dataset, name)[0])) << name;
    EXPECT_FALSE(std::isnan(values(result.dataset, name)[1])) << name;
  }
  Sweep alone = sweep_of(scene, {{Parameter("xs"), {6.0}}});
  EXPECT_EQ(values(result.dataset, "x_max")[1], values(run(alone, {}).dataset, "x_max")[0]);
  sweep.dimensions[0][0].values = {0.01, 0.5};  // starting anew from a scene that narrower stops have come past
  sweep.problem.start.displacement = 0.8;
  sweep.problem.time.max_impacts = 100;
  EXPECT_EQ(statuses(run(sweep, {}).dataset), (std::vector<std::uint8_t>{16, 0}));
}

TEST(Run, a_failed_point_says_how_far_it_came) {
  point::Problem scene = paper_scene(0.5, 1.0);  // two impacts a period
  scene.time.max_impacts = 21;
  scene.integration.shortcuts = false;
  point::ThreadScratch nothing;
  const point::PointResult result = run_point(scene, nothing);
  EXPECT_EQ(result.status, steady::Status::event_budget);
  EXPECT_EQ(result.impacts, 22.0);
  EXPECT_NEAR(result.periods, 10.0, 1.0);
}

TEST(Run, progress_reaches_the_total_along_a_chain_too) {
  Sweep sweep = sweep_of(paper_scene(6.0, 1.0), {{Parameter("nu"), std::vector<double>(50, 0.9)}});
  for (const bool follow : {false, true}) {
    if (follow) sweep.follow = 0;
    double last = 0;
    std::size_t calls = 0;
    const auto report = [&](double done, std::size_t total) {
      EXPECT_GE(done, last);  // a late report may come before the next point is finished
      EXPECT_EQ(total, 50u);
      last = done, ++calls;
    };
    (void)run(sweep, {.threads = 2, .progress = report});
    EXPECT_EQ(last, 50.0);
    EXPECT_GE(calls, 2u);  // at once after the first point, and at the end
  }
}

/// Sum over the harmonics of the distance between two spectra.
double distance(const observables::Spectrum& a, const observables::Spectrum& b) {
  double sum = std::abs(a.amplitude[0] - b.amplitude[0]);
  for (std::size_t k = 1; k < a.amplitude.size(); ++k)
    sum += std::abs(std::polar(a.amplitude[k], a.phase[k]) - std::polar(b.amplitude[k], b.phase[k]));
  return sum;
}

TEST(Run, sampled_harmonics_approach_the_exact_ones_as_fast_as_theory_says) {
  point::Problem scene = paper_scene(0.5, 1.0);  // Fig. 18
  scene.observe.harmonics = 5;
  scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
  point::ThreadScratch nothing;
  const point::PointResult exact = run_point(scene, nothing);
  scene.observe.harmonics_method = observables::HarmonicsMethod::fft;
  // the error depends on where the impacts fall between samples: the mean over sizes in a row
  const auto errors = [&](std::int64_t samples) {
    double x = 0.0, v = 0.0;
    for (std::int64_t n = samples; n < samples + 16; ++n) {
      scene.observe.harmonics_samples = n;
      point::ThreadScratch scratch{observables::Harmonics::scratch_for(scene.observe)};
      const point::PointResult sampled = run_point(scene, scratch);
      x += distance(sampled.x_spectrum, exact.x_spectrum) / 16;
      v += distance(sampled.v_spectrum, exact.v_spectrum) / 16;
    }
    return std::pair{x, v};
  };
  const auto [coarse_x, coarse_v] = errors(256);
  const auto [fine_x, fine_v] = errors(4096);
  EXPECT_NEAR(std::log2(coarse_x / fine_x) / 4, 2.0, 0.25);  // x has kinks: second order
  EXPECT_NEAR(std::log2(coarse_v / fine_v) / 4, 1.0, 0.25);  // x' has jumps: first order
}

TEST(Run, harmonics_beyond_half_the_sampling_rate_have_no_value) {
  point::Problem scene =
      paper_scene(3.0, 0.868);  // Fig. 23: two forcing periods, so harmonic k is the transform's 2k-th
  scene.observe.harmonics = 4;
  scene.observe.harmonics_samples = 14;
  point::ThreadScratch scratch{observables::Harmonics::scratch_for(scene.observe)};
  const point::PointResult result = run_point(scene, scratch);
  for (std::size_t k = 0; k <= 4; ++k) EXPECT_EQ(std::isnan(result.x_spectrum.amplitude[k]), 2 * 2 * k >= 14) << k;
}

TEST(Run, sampled_harmonics_of_a_response_are_known_without_its_samples) {
  point::Problem scene = paper_scene(6, 1.1);
  scene.oscillator.load = 0.3, scene.start.phase = 0.7;
  scene.observe.harmonics = 4;
  scene.observe.harmonics_samples = 7;  // the fourth is beyond half their rate
  point::ThreadScratch scratch{observables::Harmonics::scratch_for(scene.observe)};
  const point::PointResult known = run_point(scene, scratch);
  EXPECT_EQ(known.found_by, steady::FoundBy::closed_form);
  EXPECT_EQ(known.evaluations, 0);
  scene.integration.shortcuts = false;  // takes them
  const point::PointResult flown = run_point(scene, scratch);
  EXPECT_GT(flown.evaluations, 7);
  for (const auto spectrum : {&point::PointResult::x_spectrum, &point::PointResult::v_spectrum}) {
    EXPECT_NEAR((known.*spectrum).phase[1], (flown.*spectrum).phase[1], 1e-11);  // what it calls a repeat
    for (std::size_t k = 0; k <= 4; ++k) {
      EXPECT_EQ(std::isnan((known.*spectrum).amplitude[k]), k == 4) << k;
      EXPECT_EQ(std::isnan((flown.*spectrum).amplitude[k]), k == 4) << k;
    }
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR((known.*spectrum).amplitude[k], (flown.*spectrum).amplitude[k], 1e-11) << k;
  }
}

TEST(Run, too_few_samples_for_the_base_frequency_give_no_harmonics_at_all) {
  point::Problem scene =
      paper_scene(3.0, 0.9);  // Fig. 23: aperiodic, so the samples are shared by the periods of the window
  scene.time.max_periods = 20;
  scene.time.window = 32;
  scene.observe.harmonics = 1;
  for (std::int64_t samples : {64, 66}) {
    scene.observe.harmonics_samples = samples;
    point::ThreadScratch scratch{observables::Harmonics::scratch_for(scene.observe)};
    const point::PointResult result = run_point(scene, scratch);
    ASSERT_EQ(result.status, steady::Status::aperiodic);
    for (double amplitude : result.v_spectrum.amplitude) EXPECT_EQ(std::isnan(amplitude), samples == 64);
  }
}

TEST(Run, observed_time_is_described) {
  point::Problem scene = paper_scene(3.0, 0.868);
  scene.observe = {};
  scene.observe.harmonics = 1;
  scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
  scene.observe.impacts = true;
  scene.observe.period = true;
  point::ThreadScratch nothing;
  const point::PointResult forced = run_point(scene, nothing);
  EXPECT_EQ(forced.period_ratio, 2.0);
  EXPECT_EQ(forced.base_frequency, 0.868);
  EXPECT_NEAR(forced.period, 4 * std::numbers::pi / 0.868, 1e-14);
  EXPECT_TRUE(std::isnan(forced.eigenfrequency));
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = 20.0;
  const point::PointResult transient = run_point(scene, nothing);
  EXPECT_EQ(transient.status, steady::Status::transient);
  EXPECT_DOUBLE_EQ(transient.base_frequency, 2 * std::numbers::pi / 20);
  EXPECT_TRUE(std::isnan(transient.period) && std::isnan(transient.period_ratio));
  point::Problem held = paper_scene(0.5, 1.0);
  held.oscillator = {0.1, 0.0, 1.0, 2.0};
  held.observe = scene.observe;
  const point::PointResult still = run_point(held, nothing);
  EXPECT_EQ(still.status, steady::Status::periodic);
  EXPECT_TRUE(std::isnan(still.period));
  EXPECT_EQ(still.rest_fraction[1], 1.0);
  EXPECT_EQ(still.rest_fraction[0], 0.0);
}

}  // namespace
}  // namespace clatter::sweep::run_test
