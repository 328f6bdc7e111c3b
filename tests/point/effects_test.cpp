// Leaving effects out changes nothing: random scenes, simulated with the effects that they call for and with all.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <string>

#include "hard/any_scene.hpp"
#include "point/point.hpp"
#include "support/deviation.hpp"

namespace clatter::point::effects_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

PointResult result_of(Problem scene, bool all_effects) {
  scene.integration.all_effects = all_effects;
  ThreadScratch none;
  return run_point(scene, none);
}

/// The largest place and velocity of a run.
double size_of(const Problem& scene, const PointResult& result) {
  double size = std::max({std::abs(scene.start.displacement) + std::abs(scene.oscillator.load), result.x_max,
                          -result.x_min, std::abs(scene.start.velocity), result.v_max, -result.v_min});
  for (const observables::LoggedImpact& impact : result.log) size = std::max(size, std::abs(impact.before));
  return size;
}

/// How much the impacts of a run multiply a change: the product of the norms of their shears, each with the flight
/// before it, and for the times the softness of the impacts that tell them. Infinite in a graze. If speed and force
/// hold the mass on a stop, nothing is left of a change.
double stretch_of(const Problem& scene, const PointResult& result) {
  const Oscillator& o = scene.oscillator;
  const double size = size_of(scene, result), force = std::abs(o.forcing) + std::abs(o.load);
  double stretch = 1, last = 0, worst = 1;
  for (const observables::LoggedImpact& impact : result.log) {
    const double speed = std::abs(impact.before);
    const double position = impact.stop > 0 ? scene.stops.upper : scene.stops.lower;
    const double shear = 2 * (force + std::abs(position) + 2 * o.damping * speed) / speed;
    worst = std::max(worst, stretch * (1 + shear + size / (speed * scene.time.duration)));
    const double flight = std::min(1.0, impact.time - last), growth = 1 + std::sqrt(shear * flight);
    stretch = impact.after == 0 ? 1 + shear : stretch * growth * growth, last = impact.time;
  }
  return std::max(worst, stretch);
}

/// The larger of what two runs of a scene differ by, relative: in contacts, their times and velocities, in extrema and
/// the end. Infinite if they are not the same contacts.
double difference(const Problem& scene, const PointResult& one, const PointResult& other) {
  if (one.status != other.status || one.log.size() != other.log.size()) return infinity;
  const double size = size_of(scene, one);
  double worst = 0;
  for (std::size_t i = 0; i < one.log.size(); ++i) {
    const observables::LoggedImpact &a = one.log[i], &b = other.log[i];
    if (a.stop != b.stop) return infinity;
    worst = std::max({worst, std::abs(a.time - b.time) / scene.time.duration, std::abs(a.before - b.before) / size,
                      std::abs(a.after - b.after) / size});
  }
  for (const double d :
       {one.end.displacement - other.end.displacement, one.end.velocity - other.end.velocity, one.x_min - other.x_min,
        one.x_max - other.x_max, one.v_min - other.v_min, one.v_max - other.v_max})
    worst = std::isnan(d) ? infinity : std::max(worst, std::abs(d) / size);
  return worst;
}

/// An effect, how a random scene is made to do without it, and whether the set found does.
struct Dropped {
  const char* effect;
  void (*without)(Problem&, support::Random&);
  bool (*absent)(const Problem&, const Effects&);
};

void any_width(Problem& scene, support::Random& random, double R) {
  const double lower = random.logarithmic(0.1, 3), upper = random.logarithmic(0.1, 3);
  scene.stops = {-lower, upper, R, R};
  scene.start = {random.uniform(-lower, upper), random.uniform(-2, 2), random.uniform(0, 2 * std::numbers::pi)};
}

constexpr std::array dropped{
    Dropped{"damping", [](Problem& s, support::Random&) { s.oscillator.damping = 0; },
            [](const Problem&, const Effects& e) { return e.damping == Damping::none; }},
    Dropped{"forcing", [](Problem& s, support::Random&) { s.oscillator.forcing = 0; },
            [](const Problem&, const Effects& e) { return e.forcing == Forcing::none; }},
    Dropped{
        "resonance", [](Problem& s, support::Random& r) { s.oscillator.frequency = r.happens(0.5) ? 1.1 : 0.9; },
        [](const Problem& s, const Effects& e) { return s.oscillator.forcing == 0 || e.forcing == Forcing::regular; }},
    Dropped{"load", [](Problem& s, support::Random&) { s.oscillator.load = 0; },
            [](const Problem&, const Effects& e) { return !e.load; }},
    Dropped{"lower stop",
            [](Problem& s, support::Random& r) {
              any_width(s, r, 0.8);
              const double reach = norm(s.start.displacement - s.oscillator.load, s.start.velocity);
              s.stops.lower = s.oscillator.load - (reach + std::abs(s.oscillator.forcing) * s.time.duration) * 1.01;
            },
            [](const Problem&, const Effects& e) { return !e.lower; }},
    Dropped{"upper stop",
            [](Problem& s, support::Random& r) {
              any_width(s, r, 0.8);
              const double reach = norm(s.start.displacement - s.oscillator.load, s.start.velocity);
              s.stops.upper = s.oscillator.load + (reach + std::abs(s.oscillator.forcing) * s.time.duration) * 1.01;
            },
            [](const Problem&, const Effects& e) { return !e.upper; }},
    Dropped{"both stops",
            [](Problem& s, support::Random& r) {
              any_width(s, r, 0.8);
              s.oscillator.damping = r.logarithmic(0.02, 3);
              s.stops.lower = s.stops.upper = 0;
              const Requirements free = requirements_of(s, duration_of(s.time));
              s.stops.lower = s.oscillator.load - free.reach * 1.001,
              s.stops.upper = s.oscillator.load + free.reach * 1.001;
            },
            [](const Problem&, const Effects& e) { return !e.stops(); }},
    Dropped{"dissipation", [](Problem& s, support::Random& r) { any_width(s, r, 1.0); },
            [](const Problem&, const Effects& e) { return !e.dissipation; }},
    Dropped{"chatter and rest",
            [](Problem& s, support::Random& r) {
              any_width(s, r, r.uniform(0, 1));
              s.oscillator.load *= 0.05;
              s.oscillator.forcing =
                  std::copysign(std::min(s.stops.upper - s.oscillator.load, s.oscillator.load - s.stops.lower) *
                                    r.uniform(0.1, 0.999),
                                s.oscillator.forcing);
              s.start.velocity = r.sign() * r.uniform(1, 5);
            },
            [](const Problem&, const Effects& e) { return !e.rest; }}};

TEST(Effects, without_an_effect_that_a_scene_does_not_call_for_it_runs_as_with_all) {
  for (std::size_t kind = 0; kind < dropped.size(); ++kind) {
    int checked = 0, fewer = 0, impacts = 0;
    double worst = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
      support::Random random(500 + kind, i);
      Problem scene = hard::any_scene(i).scene;
      scene.oscillator.stiffness = 1.0;  // effects are dropped by its bounds
      scene.time.duration = std::min(scene.time.duration, 30.0);
      dropped[kind].without(scene, random);
      scene.observe.impact_log = scene.observe.extrema = true;
      scene.time.max_impacts = 50;
      const Effects effects = required_effects(scene, duration_of(scene.time));
      ASSERT_TRUE(dropped[kind].absent(scene, effects)) << dropped[kind].effect << "\n"
                                                        << support::configuration_of(scene, scene.time.duration);
      const PointResult all = result_of(scene, true);
      const double stretch = stretch_of(scene, all);
      const PointResult some = result_of(scene, false);
      EXPECT_EQ(all.status, some.status) << support::configuration_of(scene, scene.time.duration);
      if (failed(all.status) || !(stretch < 1e6)) continue;  // more than 50 impacts
      // to 1e-14 if nothing stretches it: an ulp of every term of an arc and its time, for each of up to 50 impacts
      const double d = difference(scene, all, some) / (1e-14 * stretch);
      EXPECT_LE(d, 1) << "without " << dropped[kind].effect << ", scene " << i << "\n"
                      << support::configuration_of(scene, scene.time.duration);
      worst = std::max(worst, d), ++checked, impacts += static_cast<int>(all.log.size());
      fewer += effect_set_of(effects) != effect_set_of(all_effects(scene.oscillator));
    }
    std::cout << "without " << dropped[kind].effect << ": " << checked << " scenes, " << fewer
              << " in a smaller set of effects, " << impacts << " impacts; at most " << worst
              << " of what is allowed\n";
    EXPECT_GT(checked, 100) << dropped[kind].effect;
    EXPECT_GT(fewer, 50) << dropped[kind].effect;
    EXPECT_GT(impacts, std::string(dropped[kind].effect) == "both stops" ? -1 : 200) << dropped[kind].effect;
  }
}

TEST(Effects, one_stop_that_is_hit_can_throw_the_mass_at_the_other) {
  // free of stops |x| stays below 1, but between -3 and 0 the force of frequency 2 meets the half oscillator's
  // resonance
  Problem scene;
  scene.oscillator = {0.01, 1.0, 2.0, 0.0};
  scene.stops = {-3.0, 0.0, 0.99, 0.99};
  scene.observe.impact_log = true;
  scene.time.mode = steady::Mode::transient, scene.time.duration = 100.0;
  for (const bool all : {true, false}) {
    const PointResult result = result_of(scene, all);
    EXPECT_GT(std::count_if(result.log.begin(), result.log.end(),
                            [](const observables::LoggedImpact& i) { return i.stop < 0; }),
              5)
        << all;
  }
}

TEST(Effects, all_are_run_in_the_complete_set) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Problem scene = hard::any_scene(i).scene;
    EXPECT_TRUE(contains(all_effects(scene.oscillator), effects_of(scene)));
    scene.integration.all_effects = true;
    EXPECT_EQ(effects_of(scene), all_effects(scene.oscillator));
  }
}

}  // namespace
}  // namespace clatter::point::effects_test
