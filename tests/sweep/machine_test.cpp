#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "support/dataset.hpp"
#include "support/random.hpp"
#include "sweep/run.hpp"

namespace clatter::sweep::machine_test {
namespace {

/// A machine in SI, and units of length and time of somebody else's choice.
struct Drawn {
  GivenProblem problem{};
  double length = 1, time = 1;
};

/// A machine of a milligram to a tonne that meets its stops a few times in three forcing periods.
Drawn drawn(std::uint64_t i) {
  support::Random random(25, i);
  const double mass = random.logarithmic(1e-6, 1e3), rate = random.logarithmic(1, 1e4),
               size = random.logarithmic(1e-5, 1);  // kg, rad/s, m
  Drawn it{.length = random.logarithmic(1e-3, 1e3), .time = random.logarithmic(1e-3, 1e3)};
  GivenProblem& machine = it.problem;
  machine.is_si = true, machine.mass = mass;
  auto& [h, force, frequency, load, stiffness, shape, paces] = machine.oscillator;
  stiffness = random.happens(0.7) ? mass * rate * rate : random.happens(0.5) ? 0 : -mass * rate * rate;
  machine.damper = 2 * random.uniform(0, 0.3) * mass * rate;
  if (stiffness != 0 && random.happens(0.3))
    machine.damper = 0, machine.damping_ratio = random.uniform(0, 0.3);
  else if (stiffness != 0 && random.happens(0.3))
    machine.damper = 0, machine.quality = random.uniform(2, 20);
  frequency = rate * random.uniform(0.5, 2) / (2 * std::numbers::pi);
  if (random.happens(0.8)) force = random.sign() * random.uniform(0.5, 2) * mass * rate * rate * size;
  if (random.happens(0.3)) load = random.uniform(-0.2, 0.2) * mass * rate * rate * size;
  if (random.happens(0.2))
    machine.shaking.base = random.uniform(0.1, 0.5) * size;
  else if (random.happens(0.2))
    machine.shaking.stops = random.uniform(0.1, 0.5) * size;
  machine.stops = {-size * random.uniform(0.3, 1), size * random.uniform(0.3, 1), random.uniform(0.4, 1), 0.8};
  machine.start = {random.uniform(-0.2, 0.2) * size, random.uniform(-1, 1) * size * rate, random.uniform(0, 6)};
  machine.time = {.mode = steady::Mode::transient, .duration = 3 / frequency};
  machine.observe.extrema = machine.observe.energy = machine.observe.impact_log = true;
  machine.observe.trajectory = 50, machine.observe.harmonics = 2;
  return it;
}

/// The coefficient of the damping in N s/m.
double damping_of(const GivenScene& machine) {
  const double critical = 2 * std::sqrt(std::abs(machine.oscillator.stiffness) * machine.mass);
  if (std::isfinite(machine.quality)) return critical / (2 * machine.quality);
  return machine.damper + machine.damping_ratio * critical;
}

/// The same, scaled by hand into [scene]: in these units of length and time and that of mass.
GivenProblem scaled(const Drawn& it) {
  const auto& [machine, length, time] = it;
  const double force = machine.mass * length / (time * time), speed = length / time;
  GivenProblem scene = machine;
  scene.is_si = false, scene.mass = 1;
  scene.damper = scene.damping_ratio = 0, scene.quality = HUGE_VAL;
  scene.oscillator = {.damping = damping_of(machine) * time / (2 * machine.mass),
                      .forcing = machine.oscillator.forcing / force,
                      .frequency = 2 * std::numbers::pi * machine.oscillator.frequency * time,
                      .load = machine.oscillator.load / force,
                      .stiffness = machine.oscillator.stiffness * time * time / machine.mass};
  scene.stops.lower /= length, scene.stops.upper /= length;
  scene.shaking.stops /= length, scene.shaking.base /= length;
  scene.start.displacement /= length, scene.start.velocity /= speed;
  scene.time.duration /= time;
  return scene;
}

/// Expects each result of the machine to be that of the scene times its unit, to a share of the largest value and what
/// a start moved by ten thousand roundings changes.
void expect_same(const Drawn& it, const results::Dataset& machine, const results::Dataset& scene,
                 const results::Dataset& moved) {
  const double speed = it.length / it.time, mass = it.problem.mass, energy = mass * speed * speed;
  const std::vector<std::pair<std::string, double>> units{
      {"x_min", it.length},       {"x_max", it.length},      {"v_min", speed},
      {"v_max", speed},           {"x", it.length},          {"v", speed},
      {"tau", it.time},           {"impact_tau", it.time},   {"impact_v_before", speed},
      {"impact_v_after", speed},  {"work_in", energy},       {"loss_damping", energy},
      {"loss_impact", energy},    {"impulse", mass * speed}, {"impact_power", energy / it.time},
      {"x_amplitude", it.length}, {"v_amplitude", speed},    {"base_frequency", 1 / (2 * std::numbers::pi * it.time)}};
  for (const auto& [name, unit] : units) {
    const std::vector<double>&of_machine = values(machine, name), &of_scene = values(scene, name),
          &of_moved = values(moved, name);
    ASSERT_EQ(of_machine.size(), of_scene.size()) << name;
    ASSERT_EQ(of_machine.size(), of_moved.size()) << name;
    double largest = name.starts_with("x") ? it.problem.stops.upper : 0;
    if (name == "work_in") largest = values(machine, "loss_damping")[0];
    for (const double value : of_machine) largest = std::max(largest, std::abs(value));
    // conversions and their sums are a few hundred roundings; impacts amplify them as they do the other start
    for (std::size_t i = 0; i < of_machine.size(); ++i)
      EXPECT_NEAR(of_machine[i], of_scene[i] * unit, 1e-13 * largest + unit * std::abs(of_moved[i] - of_scene[i]))
          << name << ' ' << i;
  }
}

TEST(Machine, is_the_scene_that_is_scaled_by_hand) {
  std::size_t impacts = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Drawn it = drawn(i);
    const results::Dataset machine = run({.problem = it.problem}, {}).dataset,
                           scene = run({.problem = scaled(it)}, {}).dataset;
    Drawn other = it;
    other.problem.start.displacement += 1e-12 * it.problem.stops.upper;
    const results::Dataset moved = run({.problem = scaled(other)}, {}).dataset;
    ASSERT_EQ(statuses(machine), statuses(scene)) << i;
    expect_same(it, machine, scene, moved);
    impacts += values(machine, "impact_tau").size();
    ASSERT_FALSE(HasFailure()) << "machine " << i;
  }
  EXPECT_GT(impacts, 1000u);
}

TEST(Machine, follows_an_axis_of_its_mass_with_the_velocity_kept) {
  // each point begins where the one before ended: with its velocity in m/s, whatever the units of time of the two
  Sweep sweep{.problem = drawn(1).problem, .follow = 0};
  GivenScene machine;
  machine.is_si = true, machine.damper = 0.5, machine.oscillator.stiffness = 100;
  static_cast<GivenScene&>(sweep.problem) = machine;
  sweep.problem.start = {0, 0.5, 0}, sweep.problem.stops = {-10, 10, 1, 1};
  sweep.problem.time.duration = 0.3;
  sweep.dimensions = {{{Parameter("mass"), {1, 2, 5}}}};
  const results::Dataset dataset = run(sweep, {}).dataset;
  const std::vector<double>&x = values(dataset, "x"), &v = values(dataset, "v");
  const std::size_t samples = x.size() / 3;
  for (const std::size_t point : {1U, 2U}) {
    EXPECT_NEAR(x[point * samples], x[point * samples - 1], 1e-15);
    EXPECT_NEAR(v[point * samples], v[point * samples - 1], 1e-14);  // two conversions
  }
}

TEST(Machine, names_the_unit_of_every_result) {
  Drawn it = drawn(3);
  it.problem.observe.period = it.problem.observe.stability = it.problem.observe.impacts = true;
  const results::Dataset dataset =
      run({.problem = it.problem, .dimensions = {{{Parameter("frequency"), {20, 30}}}, {{Parameter("mass"), {1, 2}}}}},
          {})
          .dataset;
  const std::pair<const char*, const char*> units[] = {{"x_max", "m"},
                                                       {"v_max", "m s-1"},
                                                       {"x", "m"},
                                                       {"v", "m s-1"},
                                                       {"tau", "s"},
                                                       {"impact_tau", "s"},
                                                       {"work_in", "J"},
                                                       {"impact_v_after", "m s-1"},
                                                       {"impulse", "N s"},
                                                       {"mass", "kg"},
                                                       {"impact_power", "W"},
                                                       {"frequency", "Hz"},
                                                       {"period", "s"},
                                                       {"base_frequency", "Hz"},
                                                       {"lyapunov", "s-1"},
                                                       {"x_phase", "rad"},
                                                       {"period_ratio", "1"},
                                                       {"status", "1"}};
  for (const auto& [name, unit] : units) EXPECT_EQ(find(dataset, name)->units, unit) << name;
}

}  // namespace
}  // namespace clatter::sweep::machine_test
