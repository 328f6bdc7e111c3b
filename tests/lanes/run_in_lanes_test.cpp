// A point that a whole block runs: it has the same result as in a sweep, and says whether lanes observed it.

#include "lanes/run_in_lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sweep/figures.hpp"

namespace clatter::lanes::run_in_lanes_test {
namespace {

point::WorkItem item_of(const point::Problem& scene) { return {0, 0, scene, effects_of(scene)}; }

point::Problem observed_scene() {
  point::Problem scene = sweep::paper_scene(0.5, 1.0);
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.harmonics = 3;
  scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
  scene.observe.impacts = true;
  return scene;
}

TEST(LanePoints, are_those_of_a_sweep_however_many_run) {
  const point::Problem scene = observed_scene();
  ASSERT_TRUE(accepts(item_of(scene)));
  const results::Dataset dataset =
      sweep::run(sweep::sweep_of(scene, {}), {.threads = 1, .arch = InstructionSet::sse2}).dataset;
  for (const std::size_t times : {std::size_t{1}, lanes_per_block, 2 * lanes_per_block + 3}) {
    point::ThreadScratch scratch;
    const point::PointResult result = run_in_lanes(item_of(scene), times, InstructionSet::sse2, scratch);
    EXPECT_TRUE(result.in_lanes);
    EXPECT_EQ(result.status, steady::Status::periodic);
    EXPECT_EQ(result.v_max, values(dataset, "v_max")[0]);
    EXPECT_EQ(result.periods, values(dataset, "simulated_periods")[0]);
    EXPECT_EQ(result.x_spectrum.amplitude, values(dataset, "x_amplitude"));
  }
}

/// Rounding may make a time of whole periods longer or shorter than they are by an ulp or more.
TEST(LanePoints, of_a_transient_have_each_state_of_the_section_once) {
  for (const double nu : {1.0, 0.7, 3.6144460222366099})
    for (const double off : {-3e-13, -1e-15, 0.0, 1e-15, 3e-13}) {
      point::Problem scene = observed_scene();
      scene.oscillator.frequency = nu;
      scene.time.mode = steady::Mode::transient;
      scene.time.duration = 40 * period_of(scene.oscillator) * (1 + off);
      scene.observe = {};
      scene.observe.section = 40;
      point::ThreadScratch scratch;
      const point::PointResult lanes = run_in_lanes(item_of(scene), 1, InstructionSet::sse2, scratch);
      const point::PointResult scalar = run_point(scene, scratch);
      EXPECT_TRUE(lanes.in_lanes);
      ASSERT_EQ(lanes.section_x.size(), 40U);
      ASSERT_EQ(scalar.section_x.size(), 40U);
      for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_NEAR(lanes.section_x[i], scalar.section_x[i], 1e-10) << nu << ' ' << off << ' ' << i;
        EXPECT_NEAR(lanes.section_v[i], scalar.section_v[i], 1e-10) << nu << ' ' << off << ' ' << i;
      }
    }
}

TEST(LanePoints, of_a_transient_have_harmonics_of_the_force_over_whole_periods_alone) {
  struct Given {
    double periods, base;  // 0: that of the transient
  };
  for (const auto& [periods, base] : {Given{5, 1.0}, Given{5, 0.2}, Given{5, 0.0}, Given{5.5, 1.0}}) {
    point::Problem scene = observed_scene();
    scene.time.mode = steady::Mode::transient, scene.time.duration = periods * 2 * std::numbers::pi;
    scene.observe.base_frequency = base;
    point::ThreadScratch scratch;
    const point::PointResult lanes = run_in_lanes(item_of(scene), lanes_per_block, InstructionSet::sse2, scratch);
    const point::PointResult scalar = run_point(scene, scratch);
    EXPECT_EQ(lanes.in_lanes, base == 1.0 && periods == 5);
    EXPECT_FALSE(scalar.in_lanes);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(lanes.x_spectrum.amplitude[k], scalar.x_spectrum.amplitude[k], 1e-14) << base << ' ' << k;
      EXPECT_NEAR(lanes.v_spectrum.amplitude[k], scalar.v_spectrum.amplitude[k], 1e-14) << base << ' ' << k;
    }
  }
}

TEST(LanePoints, meet_stops_or_are_transients) {
  point::Problem scene = observed_scene();
  scene.stops = {-10, 10, 0.7, 0.7};
  EXPECT_FALSE(accepts(item_of(scene))) << "a closed form is known";
  scene.time.mode = steady::Mode::transient, scene.time.duration = 1;
  EXPECT_TRUE(accepts(item_of(scene)));
  scene.oscillator.damping = 1;
  EXPECT_FALSE(accepts(item_of(scene)));
}

TEST(LanePoints, without_a_spring_are_bounded_by_stops_or_pressed_onto_the_only_one) {
  const double none = std::numeric_limits<double>::infinity();
  struct Given {
    double k, load;
    Stops stops;
    bool accepted;
  };
  for (const auto& [k, load, stops, accepted] : {Given{0, 0, {-1, 1, 0.7, 0.7}, true},
                                                 {-1, 0.2, {-1, 1, 0.7, 0.7}, true},
                                                 {-0.5, 0, {-1, 1, 0.7, 0.7}, false},  // runs with k = -1
                                                 {0, -0.5, {0, none, 0.7, 0.7}, true},
                                                 {0, 0.5, {-none, 0, 0.7, 0.7}, true},
                                                 {0, 0.5, {0, none, 0.7, 0.7}, false},  // escapes
                                                 {0, 0, {0, none, 0.7, 0.7}, false},
                                                 {-1, -0.5, {0, none, 0.7, 0.7}, false}}) {
    point::Problem scene = observed_scene();
    scene.oscillator = {0.1, 2.0, 1.0, load, k};
    scene.stops = stops;
    EXPECT_EQ(accepts(item_of(scene)), accepted) << k << ' ' << load;
  }
}

TEST(LanePoints, of_a_bouncing_ball_have_its_closed_form) {
  // once in a period it leaves the table with 2 pi R/(1 + R), for any force from pi (1 - R)/(1 + R) to the flip
  const double R = 0.8, least = pi<double>() * (1 - R) / (1 + R), flip = std::hypot(least, 2 * (1 + R * R) / 3.24);
  for (const double part : {0.05, 0.4, 0.9}) {
    const double force = least + part * (flip - least), sine = std::sqrt(force * force - least * least) / force;
    const double after = 2 * pi<double>() * R / (1 + R);
    point::Problem scene = observed_scene();
    scene.observe.harmonics = 0;  // without a spring impacts don't tell the mean displacement
    scene.oscillator = {0.0, force, 1.0, -1.0, 0.0};
    scene.stops = {0.0, std::numeric_limits<double>::infinity(), R, R};
    // half a period after an impact, and a little off the motion, which attracts
    scene.start = {after * pi<double>() - pi<double>() * pi<double>() / 2 + 2 * force * sine + least * pi<double>(),
                   after - pi<double>() + 2 * least, std::asin(sine) + pi<double>()};
    scene.start.displacement += 1e-4;
    ASSERT_TRUE(accepts(item_of(scene)));
    point::ThreadScratch scratch;
    const point::PointResult result = run_in_lanes(item_of(scene), 1, InstructionSet::sse2, scratch);
    EXPECT_TRUE(result.in_lanes);
    EXPECT_EQ(result.status, steady::Status::periodic) << part;
    EXPECT_NEAR(result.v_after[0], after, 1e-10) << part;  // a repeat to 1e-12, seen through its slow multiplier
    EXPECT_NEAR(result.v_before[0], -after / R, 1e-10) << part;
  }
}

TEST(LanePoints, have_the_section_of_the_scalar_loop) {
  struct Given {
    double nu;
    steady::Status status;
    std::size_t states;
  };
  for (const auto& [nu, status, states] :
       {Given{0.868, steady::Status::periodic, 2}, {1.0, steady::Status::transient, 7}}) {
    point::Problem scene = sweep::paper_scene(3.0, nu);
    scene.observe = {};
    scene.observe.section = 40;
    if (status == steady::Status::transient)
      scene.time.mode = steady::Mode::transient, scene.time.duration = 7 * 2 * std::numbers::pi / nu;
    point::ThreadScratch scratch;
    const point::PointResult scalar = run_point(scene, scratch);
    const point::PointResult lanes = run_in_lanes(item_of(scene), lanes_per_block, InstructionSet::sse2, scratch);
    EXPECT_TRUE(lanes.in_lanes) << nu;
    EXPECT_EQ(lanes.status, status);
    ASSERT_EQ(scalar.section_x.size(), states);
    ASSERT_EQ(lanes.section_x.size(), states);
    for (std::size_t i = 0; i < states; ++i) {
      EXPECT_NEAR(lanes.section_x[i], scalar.section_x[i], 1e-12) << nu << ", " << i;
      EXPECT_NEAR(lanes.section_v[i], scalar.section_v[i], 1e-12) << nu << ", " << i;
    }
  }
}

TEST(LanePoints, of_chaotic_motion_have_a_section_within_the_window) {
  point::Problem scene = sweep::paper_scene(3.0, 0.9);
  scene.observe = {};
  scene.observe.section = 40;
  scene.time.max_periods = 300;
  for (const std::int64_t window : {40, 39}) {
    scene.time.window = window;
    point::ThreadScratch scratch;
    const point::PointResult result = run_in_lanes(item_of(scene), 1, InstructionSet::sse2, scratch);
    ASSERT_EQ(result.status, steady::Status::aperiodic);
    EXPECT_EQ(result.in_lanes, window == 40);
    ASSERT_EQ(result.section_x.size(), 40u);
    // each state leads to the next one: the scalar loop takes it there
    point::Problem next = scene;
    next.time.mode = steady::Mode::transient, next.time.duration = 2 * std::numbers::pi / 0.9;
    for (std::size_t i = 0; i + 1 < 40; ++i) {
      next.start = {result.section_x[i], result.section_v[i], 0.0};
      next.observe.section = 0, next.observe.trajectory = 2;
      const point::PointResult there = run_point(next, scratch);
      EXPECT_NEAR(there.x[1], result.section_x[i + 1], 1e-10) << i;
      EXPECT_NEAR(there.v[1], result.section_v[i + 1], 1e-10) << i;
    }
  }
}

}  // namespace
}  // namespace clatter::lanes::run_in_lanes_test
