#include <gtest/gtest.h>

#include <cmath>

#include "scene/displacement_bound.hpp"
#include "scene/required_effects.hpp"

namespace clatter::friction_test {
namespace {

/// A force of mu whose direction always helps the mass on comes as near to the bound as one likes: at each of its turns
/// it is mu/k further from the equilibrium of that force, which decays by e^(-pi h/lambda) to the next turn.
TEST(Friction, has_the_bound_that_a_force_of_its_size_reaches) {
  const Oscillator o{.damping = 0.1, .stiffness = 1};
  const double shrinks = std::exp(-std::acos(-1.0) * 0.1 / std::sqrt(1 - 0.01));
  double amplitude = 0;
  for (int turn = 0; turn < 200; ++turn) amplitude = 0.3 + (amplitude + 0.3) * shrinks;
  EXPECT_NEAR(friction_bound(o, {0.3, 0.3}), amplitude, 1e-12);
}

TEST(Friction, is_an_effect_that_a_scene_calls_for_or_does_not) {
  Scene scene;
  scene.oscillator = {.damping = 0.1, .forcing = 1, .frequency = 1.3};
  scene.stops = {-0.5, 0.5, 0.7, 0.7};
  EXPECT_FALSE(required_effects(scene).friction);
  scene.friction = {0, 0.1};
  EXPECT_TRUE(required_effects(scene).friction);
  EXPECT_TRUE(all_effects(scene).friction);
}

/// Held by friction, a mass may rest on a stop from which the other forces pull it away.
TEST(Friction, lets_a_mass_rest_on_a_stop_that_nothing_presses_it_against) {
  Scene scene;
  scene.oscillator = {.damping = 0.1, .forcing = 0.2, .frequency = 1.3};
  scene.stops = {-0.5, 0.5, 0.7, 0.7};
  scene.start.velocity = 5;
  EXPECT_FALSE(required_effects(scene).rest);
  scene.friction = {0.35, 0.35};
  EXPECT_TRUE(required_effects(scene).rest);
}

TEST(Friction, holds_a_mass_for_good_if_the_force_can_never_move_it) {
  Scene scene;
  scene.oscillator = {.damping = 0.1, .forcing = 0.25, .frequency = 1.3, .load = 0.125};
  scene.stops = {-1, 1, 0.7, 0.7};
  scene.friction = {0.1, 0.5};
  EXPECT_TRUE(sticks_for_good(scene, 0.375));
  EXPECT_TRUE(sticks_for_good(scene, -0.125));
  EXPECT_FALSE(sticks_for_good(scene, std::nextafter(0.375, 1)));
  scene.stops.lower = 0.25;
  EXPECT_FALSE(sticks_for_good(scene, 0.25)) << "there it rests";
  scene.stops.stiffness_lower = 10;
  EXPECT_TRUE(sticks_for_good(scene, 0.25));
  EXPECT_FALSE(sticks_for_good(scene, 0.2)) << "the stop pushes it back";
}

TEST(Friction, takes_stops_out_of_the_reach_of_a_mass_that_it_never_lets_go) {
  Scene scene;
  scene.oscillator = {.damping = 0.1, .forcing = 0.25, .frequency = 1.3};
  scene.stops = {-1, 1, 0.7, 0.7};
  scene.friction = {0.1, 0.5};
  scene.start.displacement = -0.25;
  EXPECT_TRUE(never_moves(scene));
  EXPECT_FALSE(required_effects(scene).stops());
  EXPECT_NEAR(requirements_of(scene).free_reach, 0.25, 1e-14);
  scene.start.velocity = 1e-300;
  EXPECT_FALSE(never_moves(scene));
  scene.start = {-1, 0, 0};
  scene.oscillator = {.forcing = 0.125, .load = -0.75};
  EXPECT_FALSE(never_moves(scene)) << "it rests on the stop";
  EXPECT_TRUE(required_effects(scene).lower);
}

}  // namespace
}  // namespace clatter::friction_test
