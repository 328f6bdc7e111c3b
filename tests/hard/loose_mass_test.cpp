// Scenes with a loose mass that nobody chose, against a simulation that shares nothing with the program.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hard/machine.hpp"
#include "scene/given_scene.hpp"
#include "support/loose_scenes.hpp"
#include "support/random.hpp"

namespace clatter::hard::loose_mass_test {
namespace {

/// A scene in the ground's frame, whose base is shaken by b sin(nu tau + phase).
struct ShakenScene : MachineScene {
  double base_amplitude = 0;
};

ShakenScene any_scene(support::Random random) {
  ShakenScene scene;
  scene.damping = random.happens(0.2) ? 0 : random.happens(0.1) ? random.uniform(1, 3) : random.uniform(0, 0.3);
  scene.forcing = random.happens(0.1) ? 0 : random.uniform(0.1, 1), scene.frequency = random.uniform(0.3, 2.3);
  scene.phase = random.uniform(-3, 3), scene.load = random.happens(0.5) ? 0 : random.uniform(-0.5, 0.5);
  scene.base_amplitude = random.happens(0.7) ? 0 : random.uniform(-0.5, 0.5);
  scene.loose_mass = random.logarithmic(3e-3, 3);
  const double gap = random.logarithmic(0.03, 1);
  scene.wall_lower = random.happens(0.1) ? -no_stop : -gap;
  scene.wall_upper = gap * random.uniform(0.5, 1.5);
  scene.wall_R_lower = scene.wall_R_upper = random.happens(0.1) ? 0 : random.happens(0.1) ? 1 : random.uniform(0, 0.95);
  scene.loose_load = random.happens(0.4) ? 0 : random.uniform(-0.5, 0.5);
  scene.x = random.uniform(-0.5, 0.5), scene.v = random.uniform(-0.5, 0.5);
  scene.z = gap * random.uniform(-0.4, 0.4), scene.w = random.uniform(-0.5, 0.5);
  return scene;
}

/// Spring and damper pull with their base, by b (k sin + 2 h nu cos)(nu tau + phase).
MachineScene on_base_at_rest(const ShakenScene& scene) {
  MachineScene same = scene;
  const double b = scene.base_amplitude, of_sine = scene.forcing + b * scene.stiffness;
  const double of_cosine = 2 * b * scene.damping * scene.frequency;
  same.forcing = std::hypot(of_sine, of_cosine), same.phase += std::atan2(of_cosine, of_sine);
  return same;
}

/// The same for the program. Its starts are relative to a shaken base.
point::Problem problem_of(const ShakenScene& scene) {
  point::Problem problem;
  problem.oscillator = {scene.damping, scene.forcing, scene.frequency, scene.load};
  const double b = scene.base_amplitude;
  problem.start = {scene.x - b * std::sin(scene.phase), scene.v - b * scene.frequency * std::cos(scene.phase),
                   scene.phase};
  problem.shaking.base = b;
  problem.loose = {.ratio = scene.loose_mass,
                   .lower = scene.wall_lower,
                   .upper = scene.wall_upper,
                   .restitution_lower = scene.wall_R_lower,
                   .restitution_upper = scene.wall_R_upper,
                   .load = scene.loose_load,
                   .place = scene.z,
                   .velocity = scene.w};
  static_cast<Scene&>(problem) = in_shaken_frame(problem);
  return problem;
}

/// Both make errors of 1e-16 an impact, which the motion stretches; none of these is chaotic within the time.
TEST(LooseMass, of_any_scene_moves_as_a_simulation_by_series_does) {
  std::size_t strikes = 0, presses = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    const ShakenScene scene = any_scene({20, i});
    constexpr double time = 12;
    const MachineRun reference = run_machine(on_base_at_rest(scene), time, 20000);
    ASSERT_TRUE(reference.finished) << i;
    const support::LooseRun run = support::run_loose(problem_of(scene), time);
    ASSERT_EQ(run.outcome, stepping::Outcome::completed) << i;
    const double off = std::max(
        {std::abs(run.end.x - static_cast<double>(reference.x)), std::abs(run.end.v - static_cast<double>(reference.v)),
         std::abs(run.z - static_cast<double>(reference.z)), std::abs(run.w - static_cast<double>(reference.w))});
    EXPECT_LT(off, 1e-9) << i;
    strikes += run.record.strikes.size(), presses += run.record.presses.size();
  }
  EXPECT_GT(strikes, 5000u);
  EXPECT_GT(presses, 100u);
}

}  // namespace
}  // namespace clatter::hard::loose_mass_test
