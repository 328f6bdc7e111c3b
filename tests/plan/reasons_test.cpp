#include "plan/reasons.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "scene/required_effects.hpp"

namespace clatter::plan::reasons_test {
namespace {

constexpr double none = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

/// Fig. 20 and its relatives: h = 0.1, f = -1, R = 0.7, from rest.
point::Problem figure(double xs, double nu) {
  point::Problem scene;
  scene.oscillator = {0.1, -1.0, nu, 0.0};
  scene.stops = {-xs, xs, 0.7, 0.7};
  return scene;
}

Reason reason(const point::Problem& scene, const std::string& effect) {
  for (const Reason& r : reasons_of(scene))
    if (r.effect == effect) return r;
  throw std::out_of_range(effect);
}

void expect_reason(const point::Problem& scene, const std::string& effect, bool required, const std::string& why) {
  const Reason found = reason(scene, effect);
  EXPECT_EQ(found.required, required) << effect;
  EXPECT_EQ(found.why, why) << effect;
}

TEST(Reasons, a_stop_out_of_reach_is_named_with_its_bound) {
  for (const char* const stop : {"lower stop", "upper stop"})
    EXPECT_EQ(reason(figure(6, 1), stop).why.substr(0, 6), "|x| <=") << stop;
  expect_reason(figure(6, 1), "dissipation", false, "no stop in reach");
  expect_reason(figure(6, 1), "chatter and rest", false, "no stop in reach");
  EXPECT_TRUE(reason(figure(3, 1), "upper stop").required);
}

TEST(Reasons, a_stop_at_infinity_is_none) {
  point::Problem scene = figure(3, 1);
  scene.stops.lower = -none;
  expect_reason(scene, "lower stop", false, "stop_lower = -inf: no stop");
  scene.stops = {-3.0, none, 0.7, 0.7};
  expect_reason(scene, "upper stop", false, "stop_upper = inf: no stop");
}

TEST(Reasons, a_stop_is_in_reach_as_long_as_nothing_proves_the_contrary) {
  point::Problem follows = figure(6, 1.2);
  follows.start.displacement = nan;
  expect_reason(follows, "lower stop", true, "the start is the end of the point before, which isn't known yet");
  // at resonance without damping nothing bounds the motion but its duration: |f| tau
  point::Problem scene;
  scene.oscillator = {0.0, 1.0, 1.0, 0.0};
  scene.stops = {-10.0, 10.0, 1.0, 1.0};
  expect_reason(scene, "upper stop", true, "nothing bounds |x|");
  scene.time.mode = steady::Mode::transient, scene.time.duration = 9.0;
  expect_reason(scene, "upper stop", false, "|x| <= 9 < 10 until tau = 9: out of reach");
  scene.time.duration = 11.0;
  expect_reason(scene, "upper stop", true, "|x| may reach 11 >= 10");
}

TEST(Reasons, rest_needs_a_force_that_presses_the_mass_into_a_stop) {
  expect_reason(figure(3, 1), "chatter and rest", false, "|f| = 1 < 3: no stop can hold the mass");
  expect_reason(figure(0.5, 1), "chatter and rest", true, "|f| = 1 >= 0.5: a stop can be pressed");
  point::Problem beyond = figure(1.0, 1.0);
  beyond.oscillator.load = 2.0;  // an equilibrium beyond the upper stop: the load presses the mass onto it
  expect_reason(beyond, "chatter and rest", true, "|f| = 1 >= -1, the gap from the load: a stop can be pressed");
}

TEST(Reasons, dissipation_names_the_restitution_of_the_stops_in_reach) {
  point::Problem scene = figure(3, 1);
  expect_reason(scene, "dissipation", true, "R = 0.7");
  scene.stops.restitution_lower = scene.stops.restitution_upper = 1.0;
  expect_reason(scene, "dissipation", false, "R = 1: impacts keep the speed");
  scene.stops.restitution_lower = 0.25;
  expect_reason(scene, "dissipation", true, "R = 0.25 and 1");
  scene.stops.upper = none;
  expect_reason(scene, "dissipation", true, "R = 0.25");
}

TEST(Reasons, the_oscillator_names_the_terms_of_its_arcs) {
  point::Problem scene = figure(3, 1);
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

TEST(Reasons, a_loose_mass_is_named_in_place_of_stops_and_whether_it_can_strike) {
  point::Problem scene;
  scene.oscillator = {.damping = 0.05, .forcing = 0.02};
  scene.loose = {.ratio = 0.02, .lower = -0.4, .upper = 0.4, .restitution_lower = 0.8, .restitution_upper = 0.8};
  EXPECT_THROW((void)reason(scene, "upper stop"), std::out_of_range);
  EXPECT_THROW((void)reason(figure(3, 1), "loose mass"), std::out_of_range);
  const std::string why = "loose_mass = 0.02, walls at -0.4 and 0.4, R = 0.8";
  const Reason stands = reason(scene, "loose mass");
  EXPECT_TRUE(stands.required);
  EXPECT_TRUE(stands.why.starts_with(why + "; it stands, and |x| <= ")) << stands.why;
  EXPECT_TRUE(stands.why.ends_with(" < 0.4 for all time: its walls are out of reach")) << stands.why;
  scene.loose.velocity = 1e-4;
  expect_reason(scene, "loose mass", true, why);
  scene.loose.velocity = 0, scene.loose.place = 0.3;
  expect_reason(scene, "loose mass", true, why);
}

TEST(Reasons, friction_is_named_if_a_scene_has_it_and_whether_it_lets_the_mass_go) {
  const auto rubbing = [](double friction, double level) {
    point::Problem scene = figure(3, 1);
    scene.friction = {friction, level};
    return scene;
  };
  EXPECT_THROW((void)reason(figure(3, 1), "friction"), std::out_of_range);
  expect_reason(rubbing(0.2, 0.2), "friction", true, "friction = 0.2");
  expect_reason(rubbing(0.2, 0.3), "friction", true, "friction = 0.2, friction_static = 0.3");
  point::Problem held = rubbing(0.2, 1);  // |f| = 1
  expect_reason(held, "friction", true,
                "friction = 0.2, friction_static = 1: the mass never moves, since the other forces at its start never "
                "exceed 1");
  expect_reason(held, "upper stop", false, "|x| <= 0 < 3 for all time, friction included: out of reach");
  held.start.displacement = 0.01;  // the spring helps the force
  expect_reason(held, "friction", true, "friction = 0.2, friction_static = 1");
  held.start = {.velocity = 1e-9};
  expect_reason(held, "friction", true, "friction = 0.2, friction_static = 1");
}

TEST(Reasons, a_stop_is_out_of_reach_by_a_bound_that_includes_friction) {
  point::Problem scene = figure(9, 1.2);
  scene.friction = {0.2, 0.2};
  const auto reach = [&] { return requirements_of(scene).free_reach; };
  const double rubbing = reach();
  EXPECT_TRUE(reason(scene, "upper stop").why.ends_with(" < 9 for all time, friction included: out of reach"));
  scene.friction = {};
  EXPECT_NEAR(rubbing - reach(), 0.2 / std::tanh(std::acos(-1.0) * 0.1 / (2 * std::sqrt(0.99))), 1e-9);
  scene.friction = {0.2, 0.2}, scene.stops = {-3, 3, 0.7, 0.7};
  EXPECT_TRUE(reason(scene, "upper stop").why.ends_with(" >= 3, friction included"));
}

TEST(Reasons, tell_the_saving_by_an_effect_left_out) {
  const auto saves = [](const point::Problem& scene, const std::string& effect) {
    const Bounds saving = reason(scene, effect).saving;
    EXPECT_LE(saving.least, saving.most) << effect;
    return saving.least > 0;
  };
  const point::Problem between = figure(3, 1), away = figure(6, 1.2);  // h = 0.1: away from resonance
  for (const char* const effect : {"lower stop", "upper stop"}) {
    EXPECT_TRUE(saves(away, effect)) << effect;
    EXPECT_FALSE(saves(between, effect)) << effect;  // simulated
  }
  EXPECT_TRUE(saves(between, "resonance"));
  for (const char* const effect : {"damping", "forcing", "load", "dissipation", "chatter and rest"}) {
    EXPECT_FALSE(saves(between, effect)) << effect;  // simulated, or in every set
    EXPECT_FALSE(saves(away, effect)) << effect;
  }
  point::Problem conservative = figure(0.5, 1);
  conservative.oscillator.damping = 0;
  EXPECT_TRUE(saves(conservative, "damping"));
  conservative.oscillator.forcing = 0, conservative.start.velocity = 1;
  EXPECT_TRUE(saves(conservative, "forcing"));
  conservative.stops.upper = none;
  EXPECT_FALSE(saves(conservative, "upper stop"));  // one stop or two is the same set
}

}  // namespace
}  // namespace clatter::plan::reasons_test
