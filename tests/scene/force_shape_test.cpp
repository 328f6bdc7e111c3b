#include "scene/force_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/fifty_digits.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/effects.hpp"
#include "scene/given_scene.hpp"
#include "scene/parameter.hpp"
#include "support/force_table.hpp"
#include "support/random.hpp"

namespace clatter::force_shape_test {
namespace {

using support::any_force_table;

Scene between_stops(Waveform waveform, double duty = 0.5) {
  Scene scene;
  scene.oscillator = {.damping = 0.1, .forcing = 1, .frequency = 0.8, .shape = {.waveform = waveform, .duty = duty}};
  scene.stops.lower = -1, scene.stops.upper = 1;
  return scene;
}

TEST(ForceShape, a_scene_has_mirror_images_if_half_a_period_later_the_force_is_its_opposite) {
  for (const Waveform waveform : {Waveform::sine, Waveform::square, Waveform::triangle, Waveform::trapezoid})
    EXPECT_TRUE(is_symmetric(between_stops(waveform)));
  for (const Waveform waveform : {Waveform::pulse, Waveform::sawtooth, Waveform::half_sine})
    EXPECT_FALSE(is_symmetric(between_stops(waveform)));
  EXPECT_FALSE(is_symmetric(between_stops(Waveform::square, 0.3)));
  for (const auto& [waveform, duty] : {std::pair{Waveform::square, 0.5},
                                       {Waveform::square, 0.3},
                                       {Waveform::triangle, 0.5},
                                       {Waveform::sawtooth, 0.5},
                                       {Waveform::pulse, 0.5}}) {
    double off = 0;  // by the shape itself
    for (double turns = 0.011; turns < 1; turns += 0.01) {
      const ForceShape shape{waveform, duty};
      off = std::max(off, std::abs(shape_at(shape, turns).sine + shape_at(shape, turns + 0.5).sine));
    }
    EXPECT_EQ(is_symmetric(between_stops(waveform, duty)), off < 1e-12);
  }
}

TEST(ForceShape, friction_holds_a_mass_for_good_if_it_does_at_each_phase) {
  int held = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    support::Random random(5, i);
    Scene scene = between_stops(static_cast<Waveform>(i % (force_shapes.size() + 1)), random.uniform(0.05, 0.95));
    if (scene.oscillator.shape.waveform == Waveform::table) scene.oscillator.shape.table = any_force_table(random);
    scene.oscillator.forcing = random.uniform(-1, 1), scene.oscillator.load = random.uniform(-1, 1);
    scene.friction = {0.5, random.uniform(0.5, 2)};
    const double x = random.uniform(-0.9, 0.9);
    double most = 0;
    for (double turns = 0; turns < 1; turns += 1e-3) {
      const double s = scene.oscillator.shape.is_sine() ? std::sin(2 * pi<double>() * turns)
                                                        : shape_at(scene.oscillator.shape, turns).sine;
      most = std::max(most, std::abs(scene.oscillator.load - x + scene.oscillator.forcing * s));
    }
    if (std::abs(most - scene.friction.static_level) < 1e-2) continue;  // between two of these phases
    EXPECT_EQ(sticks_for_good(scene, x), most < scene.friction.static_level) << i;
    held += sticks_for_good(scene, x);
  }
  EXPECT_GT(held, 500);
}

TEST(ForceShape, a_table_has_mirror_images_if_its_rows_have_opposites_half_a_period_later) {
  const auto symmetric = [](std::vector<ForceTable::Knot> knots) {
    Scene scene = between_stops(Waveform::table);
    scene.oscillator.shape.table = kept(ForceTable(std::move(knots)));
    return is_symmetric(scene);
  };
  EXPECT_TRUE(symmetric({{0, -1, 1}, {0.5, 1, -1}}));
  EXPECT_TRUE(symmetric({{0, 2, 2}, {0.2, 0.1, 0.7}, {0.5, -2, -2}, {0.7, -0.1, -0.7}}));
  EXPECT_FALSE(symmetric({{0, 2, 2}, {0.2, 0.1, 0.7}, {0.5, -2, -2}, {0.6, -0.1, -0.7}}));
  EXPECT_FALSE(symmetric({{0, 2, 2}, {0.5, -2, -1}}));
  EXPECT_FALSE(symmetric({{0, 1, -1}}));  // a sawtooth
}

TEST(ForceShape, equal_tables_are_one) {
  const std::vector<ForceTable::Knot> knots{{0, 3, 3}, {0.25, -4, 1}};
  EXPECT_EQ(kept(ForceTable(knots)), kept(ForceTable(knots)));
  EXPECT_NE(kept(ForceTable(knots)), kept(ForceTable({{0, 3, 3}, {0.25, -4, 2}})));
  EXPECT_EQ(kept(ForceTable(knots))->peak(), 4);
}

TEST(ForceShape, numbers_of_another_type_keep_the_table_and_its_factor) {
  GivenScene given;
  given.oscillator.shape = {.waveform = Waveform::table, .table = kept(ForceTable({{0, 3, 3}, {0.25, -4, 1}}))};
  given.oscillator.forcing = 4, given.force_factor = -0.5;
  const auto scene = computed(with_numbers<FiftyDigits>(given)).first;
  EXPECT_EQ(scene.oscillator.shape.table, given.oscillator.shape.table);
  EXPECT_EQ(scene.oscillator.forcing, -2);
}

TEST(ForceShape, a_scene_in_pieces_runs_on_a_set_of_any_stiffness) {
  for (const double h : {0.0, 0.3, 1.0, 2.0}) {
    Oscillator o{.damping = h, .forcing = 1, .frequency = 1, .shape = {.waveform = Waveform::square}};
    EXPECT_TRUE(all_effects(o).stiffness);
    EXPECT_EQ(forcing_of(o), h < 1 ? Forcing::secular : Forcing::regular);
    EXPECT_TRUE(contains(all_effects(o), {.damping = damping_of(o), .forcing = forcing_of(o), .stiffness = true}));
    o.forcing = 0;
    EXPECT_EQ(forcing_of(o), Forcing::none);
  }
}

TEST(ForceShape, without_a_force_there_is_no_shape) {
  GivenScene given;
  given.oscillator.shape.waveform = Waveform::pulse;
  EXPECT_TRUE(computed(given).first.oscillator.shape.is_sine());
  given.oscillator.forcing = 1e-300;
  EXPECT_FALSE(computed(given).first.oscillator.shape.is_sine());
}

}  // namespace
}  // namespace clatter::force_shape_test
