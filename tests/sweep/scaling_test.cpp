#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "support/dataset.hpp"
#include "support/random.hpp"
#include "sweep/chains.hpp"
#include "sweep/run.hpp"

namespace clatter::sweep::scaling_test {
namespace {

/// x'' + 2 h x' + k x = f sin(nu tau) between stops, with k = 1, in steady motion with impacts.
point::Problem unit_scene() {
  point::Problem scene;
  scene.oscillator = {.damping = 0.05, .forcing = -1.0, .frequency = 0.9};
  scene.stops = {-1.5, 1.5, 0.7, 0.7};
  scene.start.velocity = 0.25;
  scene.observe.extrema = scene.observe.energy = scene.observe.period = scene.observe.stability = true;
  return scene;
}

/// The same motion, in a time that runs `rate` times as slowly.
point::Problem rescaled(point::Problem scene, double rate) {
  Oscillator& o = scene.oscillator;
  o = {o.damping * rate, o.forcing * rate * rate, o.frequency * rate, o.load * rate * rate, rate * rate};
  scene.start.velocity *= rate, scene.time.duration /= rate;
  return scene;
}

TEST(Scaling, unit_stiffness_leaves_every_number_alone) {
  const point::Problem scene = unit_scene(), same = problem_at({.problem = scene}, 0);
  EXPECT_EQ(same.units, Units{});
  EXPECT_EQ(same.oscillator.damping, scene.oscillator.damping);
  EXPECT_EQ(same.start.velocity, scene.start.velocity);
}

TEST(Scaling, stiffness_becomes_one_or_minus_one) {
  for (const double k : {9.0, -9.0}) {
    point::Problem scene;
    scene.oscillator = {.damping = 0.3, .forcing = 18, .frequency = 6, .load = 9, .stiffness = k};
    scene.start.velocity = 12, scene.time.duration = 5;
    const point::Problem computed = problem_at({.problem = scene}, 0);
    EXPECT_EQ(computed.oscillator.stiffness, std::copysign(1.0, k));
    EXPECT_DOUBLE_EQ(computed.oscillator.damping, 0.1);
    EXPECT_DOUBLE_EQ(computed.oscillator.forcing, 2);
    EXPECT_DOUBLE_EQ(computed.oscillator.frequency, 2);
    EXPECT_DOUBLE_EQ(computed.oscillator.load, 1);
    EXPECT_DOUBLE_EQ(computed.start.velocity, 4);
    EXPECT_DOUBLE_EQ(computed.time.duration, 15);
  }
}

TEST(Scaling, slower_time_gives_the_same_motion) {
  constexpr double rate = 4;  // a power of 2, so that every conversion is exact and so are the comparisons
  const results::Dataset one = run({.problem = unit_scene()}, {}).dataset,
                         other = run({.problem = rescaled(unit_scene(), rate)}, {}).dataset;
  const auto expect = [&](const std::string& name, double factor) {
    for (std::size_t i = 0; i < values(one, name).size(); ++i)
      EXPECT_EQ(values(one, name)[i] * factor, values(other, name)[i]) << name;
  };
  expect("x_max", 1), expect("v_max", rate), expect("period", 1 / rate), expect("period_ratio", 1);
  expect("lyapunov", rate), expect("multiplier_re", 1), expect("work_in", rate * rate);
  expect("impulse", rate), expect("impact_power", rate * rate * rate), expect("settling_estimate", 1);
}

/// By its definition in the units of the scene, from the states once a forcing period that two runs write.
TEST(Scaling, settling_is_counted_in_the_units_of_the_scene) {
  std::size_t compared = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    support::Random random(5, index);
    point::Problem scene;
    scene.oscillator = {random.uniform(0.02, 0.3), random.uniform(1, 9), random.uniform(1, 4), 0.0,
                        random.logarithmic(0.05, 20)};
    scene.stops = {-1, 1, random.uniform(0.2, 0.7), random.uniform(0.2, 0.7)};
    scene.start = {random.uniform(-1, 1), random.uniform(-2, 2), 0.0};
    scene.observe.settling = scene.observe.period = true, scene.observe.section = 400;
    const results::Dataset steady = run({.problem = scene}, {}).dataset;
    const double told = values(steady, "settling_periods")[0];
    if (values(steady, "period_ratio")[0] != 1 || !(told > 0 && told < 390)) continue;
    scene.observe.settling = scene.observe.period = false;
    scene.time.mode = steady::Mode::transient;
    scene.time.duration = 400 * period_of(scene.oscillator);
    const results::Dataset transient = run({.problem = scene}, {}).dataset;
    const double x = values(steady, "section_x")[0], v = values(steady, "section_v")[0];
    std::size_t settled = 0;
    for (std::size_t k = 0; k < 400; ++k) {
      const double off =
          std::max(std::abs(values(transient, "section_x")[k] - x), std::abs(values(transient, "section_v")[k] - v));
      if (off > 1e-3 * std::max(std::abs(x), std::abs(v))) settled = k + 1;
    }
    EXPECT_EQ(static_cast<double>(settled), told) << index;
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST(Scaling, follow_keeps_the_velocity_when_the_stiffness_changes) {
  // without force and damping the energy (v^2 + k x^2)/2 at the end of a point is that of the beginning of the next
  point::Problem first = unit_scene();
  first.units.time = 1;
  point::Problem next = first;
  next.units.time = 0.5;
  start_from(next, point::End{{0.1, 3.0, 0.0}}, first.units);
  EXPECT_EQ(next.start.velocity * factor_of(next.units, Quantity::velocity), 3.0);
}

TEST(Scaling, machine_gives_its_scene) {
  GivenScene machine;
  machine.is_si = true, machine.mass = 2, machine.damper = 4;
  machine.oscillator = {.forcing = 40, .frequency = 5, .load = 8, .stiffness = 800};
  const auto [scene, units] = clatter::computed(machine);
  const Oscillator& oscillator = scene.oscillator;
  EXPECT_DOUBLE_EQ(units.time, 1 / 20.0);                // (m/K)^(1/2)
  EXPECT_DOUBLE_EQ(oscillator.damping, 4.0 / (2 * 40));  // c/(2 (K m)^(1/2))
  EXPECT_DOUBLE_EQ(oscillator.forcing, 0.05);
  EXPECT_DOUBLE_EQ(oscillator.load, 0.01);
  EXPECT_DOUBLE_EQ(oscillator.frequency, 2 * std::numbers::pi * 5 / 20);
  EXPECT_EQ(oscillator.stiffness, 1);
}

TEST(Scaling, machine_without_a_spring_counts_in_the_time_of_its_force) {
  GivenScene machine;
  machine.is_si = true, machine.mass = 0.5;
  machine.oscillator = {.forcing = 3, .frequency = 10, .stiffness = 0};
  const double omega = 2 * std::numbers::pi * 10;
  const Oscillator oscillator = clatter::computed(machine).first.oscillator;
  EXPECT_EQ(oscillator.stiffness, 0);
  EXPECT_EQ(oscillator.frequency, 1);
  EXPECT_DOUBLE_EQ(oscillator.forcing, 3 / (0.5 * omega * omega));
}

TEST(Scaling, quantities_of_a_machine_are_in_si) {
  const Units units{.time = 0.5, .mass = 3, .is_si = true};
  EXPECT_DOUBLE_EQ(factor_of(units, Quantity::velocity), 2);
  EXPECT_DOUBLE_EQ(factor_of(units, Quantity::energy), 12);
  EXPECT_DOUBLE_EQ(factor_of(units, Quantity::power), 24);
  EXPECT_DOUBLE_EQ(factor_of(units, Quantity::impulse), 6);
  EXPECT_DOUBLE_EQ(factor_of(units, Quantity::frequency), 1 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(factor_of(units, Quantity::length), 1);
}

}  // namespace
}  // namespace clatter::sweep::scaling_test
