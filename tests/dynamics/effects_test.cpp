#include "dynamics/effects.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/required_effects.hpp"

namespace clatter {
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

TEST(Effects, every_set_of_a_scene_has_a_kernel_that_contains_it) {
  const auto sets = consistent_sets();
  EXPECT_EQ(sets.size(), 10u * (3 * 2 * 4 + 2));  // 10 of an oscillator; stops with what they do, or none; the load
  for (const Effects& set : sets) {
    const std::size_t kernel = kernel_of(set);
    ASSERT_LT(kernel, compiled_effects.size());
    const Effects& all = compiled_effects[kernel];
    EXPECT_TRUE(contains(all, set));
    // said again, without contains(): a flag that the set has, its forcing or more, rotation for none and light alone
    EXPECT_TRUE((all.load || !set.load) && (all.lower || !set.lower) && (all.upper || !set.upper));
    EXPECT_TRUE((all.dissipation || !set.dissipation) && (all.rest || !set.rest) && all.forcing >= set.forcing);
    EXPECT_EQ(all.damping == Damping::heavy, set.damping >= Damping::critical);
    EXPECT_TRUE(all.damping != Damping::none || set.damping == Damping::none);
  }
}

TEST(Effects, the_order_of_the_kernels_hides_none) {
  // a cheaper kernel that contained a dearer one would always be taken in its place
  EXPECT_LE(compiled_effects.size(), 16u);
  for (std::size_t i = 0; i < compiled_effects.size(); ++i) EXPECT_EQ(kernel_of(compiled_effects[i]), i);
}

TEST(Effects, what_contains_a_kernel_contains_what_it_contains) {
  const auto sets = consistent_sets();
  for (const Effects& small : sets) {
    EXPECT_TRUE(contains(small, small) || small.damping == Damping::critical);  // which no kernel is for
    for (const Effects& kernel : compiled_effects)
      for (const Effects& larger : compiled_effects) {
        EXPECT_TRUE(contains(larger, small) || !(contains(larger, kernel) && contains(kernel, small)));
      }
  }
}

TEST(Effects, a_set_is_run_by_its_cheapest_kernel) {
  for (const Effects& set : consistent_sets()) {
    const Effects run = with_effects(set, []<Effects kernel>() { return kernel; });
    EXPECT_EQ(run, compiled_effects[kernel_of(set)]);
  }
}

TEST(Effects, any_stops_are_met_with_all_that_the_oscillator_does) {
  for (const double h : {0.0, 1e-300, 0.05, 0.1, 1 - ulp, 1.0, 1 + ulp, 100.0})
    for (const double f : {0.0, 1e-300, -1.0})
      for (const double nu : {1e-3, 0.95, 1.0, 1.0625, 1e3}) {
        const Oscillator oscillator{h, f, nu, 0.5};
        const Effects own{damping_of(oscillator), forcing_of(oscillator), true, true, true, true, true};
        EXPECT_TRUE(contains(with_any_stops(oscillator, []<Effects kernel>() { return kernel; }), own));
        EXPECT_TRUE(contains(all_effects(oscillator.damping), own));
      }
}

/// Fig. 20 and its relatives: h = 0.1, f = -1, R = 0.7, from rest.
Scene figure(double xs, double nu) {
  Scene scene;
  scene.oscillator = {0.1, -1.0, nu, 0.0};
  scene.stops = {-xs, xs, 0.7, 0.7};
  return scene;
}

Reason reason(const Scene& scene, const std::string& effect) {
  for (const Reason& r : reasons_of(scene))
    if (r.effect == effect) return r;
  throw std::out_of_range(effect);
}

void expect_reason(const Scene& scene, const std::string& effect, bool required, const std::string& why) {
  const Reason found = reason(scene, effect);
  EXPECT_EQ(found.required, required) << effect;
  EXPECT_EQ(found.why, why) << effect;
}

TEST(RequiredEffects, stops_that_the_beats_never_reach_are_out) {
  // |P + iQ| + |B| is 10 at nu = 1: only the envelope of their beats, from rest about |P + iQ|, proves it
  for (int i = 0; i <= 200; ++i) {
    const double nu = 0.5 + i / 200.0;
    EXPECT_EQ(required_effects(figure(6, nu)), (Effects{Damping::light, Forcing::regular})) << nu;
  }
  for (const char* const stop : {"lower stop", "upper stop"})
    EXPECT_EQ(reason(figure(6, 1), stop).why.substr(0, 6), "|x| <=") << stop;
  expect_reason(figure(6, 1), "dissipation", false, "no stop in reach");
  expect_reason(figure(6, 1), "chatter and rest", false, "no stop in reach");
}

TEST(RequiredEffects, stops_within_the_steady_amplitude_are_in) {
  const Effects all = required_effects(figure(3, 1));  // amplitude 5
  EXPECT_TRUE(all.lower && all.upper && all.dissipation);
  expect_reason(figure(3, 1), "dissipation", true, "R = 0.7");
  EXPECT_TRUE(reason(figure(3, 1), "upper stop").required);
  EXPECT_TRUE(required_effects(figure(5.0, 1)).stops());  // the amplitude itself
}

TEST(RequiredEffects, a_stop_that_is_hit_leaves_no_proof_for_the_other) {
  // in reach by itself neither is, once the mass has hit the other: between stops at -3 and 0 the force of frequency 2
  // finds the resonance of the half oscillator (its own period is pi), where free of stops |x| stays below 1
  Scene scene;
  scene.oscillator = {0.01, 1.0, 2.0, 0.0};
  scene.stops = {-3.0, 0.0, 0.99, 0.99};
  EXPECT_TRUE(required_effects(scene).upper);
  EXPECT_TRUE(required_effects(scene).lower);
  // without force no impact raises the energy: the stop beyond it stays out of reach
  scene.oscillator = {0.0, 0.0, 1.0, 0.0};
  scene.start.displacement = -2.0;
  EXPECT_TRUE(required_effects(scene).upper);
  EXPECT_FALSE(required_effects(scene).lower);
}

TEST(RequiredEffects, a_force_weaker_than_the_spring_holds_no_mass) {
  EXPECT_FALSE(required_effects(figure(3, 1)).rest);
  expect_reason(figure(3, 1), "chatter and rest", false, "|f| = 1 < 3: no stop can hold the mass");
  expect_reason(figure(0.5, 1), "chatter and rest", true, "|f| = 1 >= 0.5: a stop can be pressed");
  EXPECT_TRUE(required_effects(figure(1.0, 1)).rest);        // a tangency
  EXPECT_TRUE(required_effects(figure(1.0 + ulp, 1)).rest);  // within rounding of one
  EXPECT_FALSE(required_effects(figure(1.0 + 16 * ulp, 1)).rest);
  Scene beyond = figure(1.0, 1.0);
  beyond.oscillator.load = 2.0;  // beyond the upper stop, which it presses the mass on
  EXPECT_TRUE(required_effects(beyond).upper && required_effects(beyond).rest);
  expect_reason(beyond, "chatter and rest", true, "|f| = 1 >= -1, the gap from the load: a stop can be pressed");
  beyond.oscillator.forcing = 0.0, beyond.oscillator.load = -2.0;
  EXPECT_TRUE(required_effects(beyond).lower && required_effects(beyond).rest);
}

TEST(RequiredEffects, dissipation_needs_a_stop_in_reach_that_takes_speed) {
  Scene scene = figure(3, 1);
  scene.stops.restitution_lower = scene.stops.restitution_upper = 1.0;
  EXPECT_FALSE(required_effects(scene).dissipation);
  expect_reason(scene, "dissipation", false, "R = 1: impacts keep the speed");
  scene.stops.restitution_lower = 1 - ulp / 2;
  EXPECT_TRUE(required_effects(scene).dissipation);
  scene.stops.restitution_lower = 0.25;
  expect_reason(scene, "dissipation", true, "R = 0.25 and 1");
  scene.stops.upper = none;
  expect_reason(scene, "dissipation", true, "R = 0.25");
  scene.stops = {-none, 3.0, 0.25, 1.0};
  EXPECT_FALSE(required_effects(scene).dissipation);  // the stop that would take it isn't there
}

TEST(RequiredEffects, a_stop_at_infinity_is_none) {
  Scene scene = figure(3, 1);
  scene.stops.lower = -none;
  EXPECT_FALSE(required_effects(scene).lower);
  EXPECT_TRUE(required_effects(scene).upper);
  expect_reason(scene, "lower stop", false, "stop_lower = -inf: no stop");
  scene.stops = {-3.0, none, 0.7, 0.7};
  EXPECT_TRUE(required_effects(scene).lower);
  expect_reason(scene, "upper stop", false, "stop_upper = inf: no stop");
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

TEST(RequiredEffects, what_isnt_known_keeps_the_stops_in) {
  ASSERT_FALSE(required_effects(figure(6, 1.2)).stops());
  for (const double unknown : {nan, none, -none}) {
    std::vector<Scene> scenes(7, figure(6, 1.2));
    scenes[0].start.displacement = unknown, scenes[1].start.velocity = unknown, scenes[2].start.phase = unknown;
    scenes[3].oscillator.damping = unknown, scenes[4].oscillator.forcing = unknown;
    scenes[5].oscillator.frequency = unknown, scenes[6].oscillator.load = unknown;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const Effects effects = required_effects(scenes[i]);
      EXPECT_TRUE(effects.lower && effects.upper) << "value " << i << " = " << unknown;
      EXPECT_TRUE(effects.rest || (i != 4 && i != 6)) << "what presses, value " << i << " = " << unknown;
    }
  }
  for (const Stops& one : {Stops{-6, none, 0.7, 0.7}, Stops{-none, 6, 0.7, 0.7}}) {  // whose gap isn't known
    Scene scene = figure(6, 1.2);
    scene.stops = one, scene.oscillator.load = nan;
    EXPECT_TRUE(required_effects(scene).stops() && required_effects(scene).rest);
  }
  Scene follows = figure(6, 1.2);
  follows.start.displacement = nan;
  expect_reason(follows, "lower stop", true, "the start isn't known before the point before has ended");
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
  expect_reason(scene, "upper stop", true, "nothing bounds |x|");
  scene.time.mode = Mode::transient, scene.time.duration = 9.0;
  EXPECT_FALSE(required_effects(scene).stops());
  expect_reason(scene, "upper stop", false, "|x| <= 9 < 10 until tau = 9: out of reach");
  scene.time.duration = 11.0;
  EXPECT_TRUE(required_effects(scene).stops());
  expect_reason(scene, "upper stop", true, "|x| may reach 11 >= 10");
}

TEST(RequiredEffects, the_oscillator_says_what_its_arcs_are_made_of) {
  Scene scene = figure(3, 1);
  expect_reason(scene, "damping", true, "h = 0.1 < 1: free motion is a decaying rotation");
  expect_reason(scene, "forcing", true, "f = -1");
  expect_reason(scene, "resonance", false,
                "hypot(h, nu - 1) = 0.1 >= 1/16: response and transient keep their digits apart");
  expect_reason(scene, "load", false, "load = 0");
  scene.oscillator = {0.03, 1.0, 1.04, 0.25};
  expect_reason(scene, "resonance", true, "hypot(h, nu - 1) = 0.05 < 1/16: response and transient nearly cancel");
  expect_reason(scene, "load", true, "load = 0.25");
  scene.oscillator = {0.0, 0.0, 1.0, 0.0};
  expect_reason(scene, "damping", false, "h = 0: no damping");
  expect_reason(scene, "forcing", false, "f = 0: no forcing");
  expect_reason(scene, "resonance", false, "f = 0: nothing to resonate with");
  scene.oscillator.damping = 1.0;
  expect_reason(scene, "damping", true, "h = 1: critical, the limit of rotation and creep");
  scene.oscillator.damping = 2.0;
  expect_reason(scene, "damping", true, "h = 2 > 1: free motion is the sum of a slow and a fast decay");
}

TEST(RequiredEffects, damping_and_resonance_are_told_apart_at_their_borders) {
  const auto damping = [](double h) { return damping_of({h, 0.0, 1.0, 0.0}); };
  EXPECT_EQ(damping(0.0), Damping::none);
  EXPECT_EQ(damping(std::numeric_limits<double>::denorm_min()), Damping::light);
  EXPECT_EQ(damping(1 - ulp / 2), Damping::light);
  EXPECT_EQ(damping(1.0), Damping::critical);
  EXPECT_EQ(damping(1 + ulp), Damping::heavy);
  EXPECT_EQ(damping(nan), Damping::heavy);  // whose kernel has no fewer terms
  const auto forcing = [](double nu) { return forcing_of({0.0, 1e-300, nu, 0.0}); };
  EXPECT_EQ(forcing(1.0), Forcing::secular);
  EXPECT_EQ(forcing(1 + secular_distance - 4 * ulp), Forcing::secular);
  EXPECT_EQ(forcing(1 + secular_distance), Forcing::regular);
  EXPECT_EQ(forcing(1 - secular_distance), Forcing::regular);
  EXPECT_EQ(forcing_of({0.0, 0.0, 1.0, 0.0}), Forcing::none);
}

}  // namespace
}  // namespace clatter
