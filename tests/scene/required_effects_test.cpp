#include "scene/required_effects.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace clatter::required_effects_test {
inline namespace scene {
namespace {

constexpr double none = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
constexpr double ulp = std::numeric_limits<double>::epsilon();

/// Every set of effects that a scene can have: no resonance of heavy damping, nothing lost or held without a stop.
std::vector<Effects> consistent_sets() {
  std::vector<Effects> sets;
  for (const Damping damping : {Damping::none, Damping::light, Damping::critical, Damping::heavy})
    for (const Forcing forcing : {Forcing::none, Forcing::regular, Forcing::secular})
      for (unsigned flags = 0; flags < 32; ++flags) {
        const auto flag = [flags](unsigned i) { return (flags >> i & 1) != 0; };
        const Effects set{damping, forcing, flag(0), flag(1), flag(2), flag(3), flag(4)};
        const bool resonance = forcing != Forcing::secular || damping <= Damping::light;
        if (resonance && (set.stops() || !(set.dissipation || set.rest))) sets.push_back(set);
      }
  return sets;
}

TEST(Effects, every_set_of_a_scene_is_contained_in_a_compiled_one) {
  const auto sets = consistent_sets();
  EXPECT_EQ(sets.size(),
            10u * (3 * 2 * 4 + 2));  // 10 sets of an oscillator's effects; stops and their effects, or none; the load
  for (const Effects& set : sets) {
    const std::size_t index = effect_set_of(set);
    ASSERT_LT(index, compiled_effects.size());
    const Effects& all = compiled_effects[index];
    EXPECT_TRUE(contains(all, set));
    // the rule once more, without contains(): each flag of the set, its forcing or more, rotation only for none and
    // light
    EXPECT_TRUE((all.load || !set.load) && (all.lower || !set.lower) && (all.upper || !set.upper));
    EXPECT_TRUE((all.dissipation || !set.dissipation) && (all.rest || !set.rest) && all.forcing >= set.forcing);
    EXPECT_EQ(all.damping == Damping::heavy, set.damping >= Damping::critical);
    EXPECT_TRUE(all.damping != Damping::none || set.damping == Damping::none);
  }
}

TEST(Effects, the_order_of_the_compiled_sets_hides_none) {
  // a cheaper compiled set that contained a dearer one would always be taken instead of it
  EXPECT_LE(compiled_effects.size(), 22u);
  for (std::size_t i = 0; i < compiled_effects.size(); ++i) EXPECT_EQ(effect_set_of(compiled_effects[i]), i);
}

TEST(Effects, contains_is_transitive_through_compiled_sets) {
  const auto sets = consistent_sets();
  for (const Effects& small : sets) {
    EXPECT_TRUE(contains(small, small) || small.damping == Damping::critical);  // which has no compiled set
    for (const Effects& between : compiled_effects)
      for (const Effects& larger : compiled_effects) {
        EXPECT_TRUE(contains(larger, small) || !(contains(larger, between) && contains(between, small)));
      }
  }
}

TEST(Effects, a_set_runs_as_the_cheapest_compiled_one) {
  for (const Effects& set : consistent_sets()) {
    const Effects run = with_effects(set, []<Effects compiled>() { return compiled; });
    EXPECT_EQ(run, compiled_effects[effect_set_of(set)]);
  }
}

TEST(Effects, any_stops_are_met_with_all_that_the_oscillator_does) {
  for (const double h : {0.0, 1e-300, 0.05, 0.1, 1 - ulp, 1.0, 1 + ulp, 100.0})
    for (const double f : {0.0, 1e-300, -1.0})
      for (const double nu : {1e-3, 0.95, 1.0, 1.0625, 1e3}) {
        const Oscillator oscillator{h, f, nu, 0.5};
        const Effects own{damping_of(oscillator), forcing_of(oscillator), true, true, true, true, true};
        EXPECT_TRUE(contains(with_any_stops(oscillator, []<Effects compiled>() { return compiled; }), own));
        EXPECT_TRUE(contains(all_effects(oscillator), own));
      }
}

/// Fig. 20 and its relatives: h = 0.1, f = -1, R = 0.7, from rest.
Scene figure(double xs, double nu) {
  Scene scene;
  scene.oscillator = {0.1, -1.0, nu, 0.0};
  scene.stops = {-xs, xs, 0.7, 0.7};
  return scene;
}

TEST(RequiredEffects, stops_that_the_beats_never_reach_are_out) {
  // |P + iQ| + |B| is 10 at nu = 1: only the envelope of their beats, from rest about |P + iQ|, proves it
  for (int i = 0; i <= 200; ++i) {
    const double nu = 0.5 + i / 200.0;
    EXPECT_EQ(required_effects(figure(6, nu)), (Effects{Damping::light, Forcing::regular})) << nu;
  }
}

TEST(RequiredEffects, stops_within_the_steady_amplitude_are_in) {
  const Effects all = required_effects(figure(3, 1));  // amplitude 5
  EXPECT_TRUE(all.lower && all.upper && all.dissipation);
  EXPECT_TRUE(required_effects(figure(5.0, 1)).stops());  // the amplitude itself
}

TEST(RequiredEffects, a_stop_that_is_hit_leaves_no_proof_for_the_other) {
  // without stops |x| stays below 1, so neither stop would be in reach; but between stops at -3 and 0 the force of
  // frequency 2 is in resonance with the half oscillator, whose own period is pi
  Scene scene;
  scene.oscillator = {0.01, 1.0, 2.0, 0.0};
  scene.stops = {-3.0, 0.0, 0.99, 0.99};
  EXPECT_TRUE(required_effects(scene).upper);
  EXPECT_TRUE(required_effects(scene).lower);
  // without force nothing raises the energy, so a stop beyond it stays out of reach
  scene.oscillator = {0.0, 0.0, 1.0, 0.0};
  scene.start.displacement = -2.0;
  EXPECT_TRUE(required_effects(scene).upper);
  EXPECT_FALSE(required_effects(scene).lower);
}

TEST(RequiredEffects, a_force_weaker_than_the_spring_holds_no_mass) {
  EXPECT_FALSE(required_effects(figure(3, 1)).rest);
  EXPECT_TRUE(required_effects(figure(1.0, 1)).rest);        // a tangency
  EXPECT_TRUE(required_effects(figure(1.0 + ulp, 1)).rest);  // within rounding of one
  EXPECT_FALSE(required_effects(figure(1.0 + 16 * ulp, 1)).rest);
  Scene beyond = figure(1.0, 1.0);
  beyond.oscillator.load = 2.0;  // an equilibrium beyond the upper stop: the load presses the mass onto it
  EXPECT_TRUE(required_effects(beyond).upper && required_effects(beyond).rest);
  beyond.oscillator.forcing = 0.0, beyond.oscillator.load = -2.0;
  EXPECT_TRUE(required_effects(beyond).lower && required_effects(beyond).rest);
}

TEST(RequiredEffects, dissipation_needs_a_stop_in_reach_that_takes_speed) {
  Scene scene = figure(3, 1);
  scene.stops.restitution_lower = scene.stops.restitution_upper = 1.0;
  EXPECT_FALSE(required_effects(scene).dissipation);
  scene.stops.restitution_lower = 1 - ulp / 2;
  EXPECT_TRUE(required_effects(scene).dissipation);
  scene.stops = {-none, 3.0, 0.25, 1.0};
  EXPECT_FALSE(required_effects(scene).dissipation);  // the stop at which energy would be lost doesn't exist
}

TEST(RequiredEffects, a_stop_at_infinity_is_none) {
  Scene scene = figure(3, 1);
  scene.stops.lower = -none;
  EXPECT_FALSE(required_effects(scene).lower);
  EXPECT_TRUE(required_effects(scene).upper);
  scene.stops = {-3.0, none, 0.7, 0.7};
  EXPECT_TRUE(required_effects(scene).lower);
}

TEST(RequiredEffects, stops_out_of_reach_are_put_at_infinity) {
  const Stops stops{-1, 2, 0.3, 0.4};
  const Stops none_met = stops_in_reach(stops, {}), upper = stops_in_reach(stops, {.upper = true});
  EXPECT_EQ(none_met.lower, -none);
  EXPECT_EQ(none_met.upper, none);
  EXPECT_EQ(upper.lower, -none);
  EXPECT_EQ(upper.upper, 2);
  EXPECT_EQ(upper.restitution_upper, 0.4);
}

TEST(RequiredEffects, unknown_quantities_keep_the_stops) {
  ASSERT_FALSE(required_effects(figure(6, 1.2)).stops());
  for (const double unknown : {nan, none, -none}) {
    std::vector<Scene> scenes(7, figure(6, 1.2));
    scenes[0].start.displacement = unknown, scenes[1].start.velocity = unknown, scenes[2].start.phase = unknown;
    scenes[3].oscillator.damping = unknown, scenes[4].oscillator.forcing = unknown;
    scenes[5].oscillator.frequency = unknown, scenes[6].oscillator.load = unknown;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const Effects effects = required_effects(scenes[i]);
      EXPECT_TRUE(effects.lower && effects.upper) << "value " << i << " = " << unknown;
      EXPECT_TRUE(effects.rest || (i != 4 && i != 6)) << "rest, value " << i << " = " << unknown;
    }
  }
  for (const Stops& one : {Stops{-6, none, 0.7, 0.7}, Stops{-none, 6, 0.7, 0.7}}) {  // the gap of the stop is NaN
    Scene scene = figure(6, 1.2);
    scene.stops = one, scene.oscillator.load = nan;
    EXPECT_TRUE(required_effects(scene).stops() && required_effects(scene).rest);
  }
  Scene loses = figure(3, 1);
  loses.stops.restitution_lower = loses.stops.restitution_upper = nan;
  EXPECT_TRUE(required_effects(loses).dissipation);
}

TEST(RequiredEffects, a_transient_reaches_no_further_than_the_force_takes_it_in_its_time) {
  // at resonance without damping nothing bounds the motion but its duration: |f| tau
  Scene scene;
  scene.oscillator = {0.0, 1.0, 1.0, 0.0};
  scene.stops = {-10.0, 10.0, 1.0, 1.0};
  EXPECT_TRUE(required_effects(scene).stops());
  EXPECT_FALSE(required_effects(scene, 9.0).stops());
  EXPECT_TRUE(required_effects(scene, 11.0).stops());
}

TEST(RequiredEffects, damping_and_resonance_are_told_apart_at_their_borders) {
  const auto damping = [](double h) { return damping_of({.damping = h}); };
  EXPECT_EQ(damping(0.0), Damping::none);
  EXPECT_EQ(damping(std::numeric_limits<double>::denorm_min()), Damping::light);
  EXPECT_EQ(damping(1 - ulp / 2), Damping::light);
  EXPECT_EQ(damping(1.0), Damping::critical);
  EXPECT_EQ(damping(1 + ulp), Damping::heavy);
  EXPECT_EQ(damping(nan), Damping::heavy);  // whose compiled set has the most terms
  const auto forcing = [](double nu) { return forcing_of({0.0, 1e-300, nu, 0.0}); };
  EXPECT_EQ(forcing(1.0), Forcing::secular);
  EXPECT_EQ(forcing(1 + secular_distance - 4 * ulp), Forcing::secular);
  EXPECT_EQ(forcing(1 + secular_distance), Forcing::regular);
  EXPECT_EQ(forcing(1 - secular_distance), Forcing::regular);
  EXPECT_EQ(forcing_of({0.0, 0.0, 1.0, 0.0}), Forcing::none);
  EXPECT_EQ(forcing(nan), Forcing::regular);
  const double part = secular_distance / std::sqrt(2.0);  // of both, so that neither tells by itself
  EXPECT_EQ(forcing_of({part * (1 - 4 * ulp), 1.0, 1 - part * (1 - 64 * ulp), 0.0}), Forcing::secular);
  EXPECT_EQ(forcing_of({part * (1 + 4 * ulp), 1.0, 1 - part * (1 + 64 * ulp), 0.0}), Forcing::regular);
  EXPECT_EQ(forcing_of({secular_distance, 1.0, 1.0, 0.0}), Forcing::regular);
}

}  // namespace
}  // namespace scene
}  // namespace clatter::required_effects_test
