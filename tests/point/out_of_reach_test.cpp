// A scene whose stops are out of reach is run without them, and its steady response is told at once: with the bits of a
// run that keeps the stops and everything that they can do, of random scenes.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "hard/any_scene.hpp"
#include "point/point.hpp"

namespace clatter::point::out_of_reach_test {
namespace {

/// A damped and forced scene between stops that lie further away than the bound of its motion: by hardly anything, or
/// by far. Of a third the phase of the start is 0.
Problem out_of_reach(std::uint64_t index) {
  support::Random random(20260, index);
  Problem scene = hard::any_scene(index).scene;
  scene.oscillator.stiffness = 1.0;
  if (!(scene.oscillator.damping > 0)) scene.oscillator.damping = random.logarithmic(1e-3, 3);
  if (scene.oscillator.forcing == 0) scene.oscillator.forcing = random.uniform(-2, 2);
  if (random.happens(1.0 / 3)) scene.start.phase = 0;
  scene.time = {};
  scene.stops = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0.7, 0.4};
  const double reach = requirements_of(scene).free_reach * (1 + random.logarithmic(1e-9, 10));
  scene.stops.lower = scene.oscillator.load - reach, scene.stops.upper = scene.oscillator.load + reach;
  scene.observe.extrema = scene.observe.period = scene.observe.impacts = true;
  return scene;
}

PointResult run_with(const Problem& scene, const Effects& effects) {
  ThreadScratch none;
  PointResult result;
  const WorkItem item{0, 0, scene, effects};
  run_batch({&item, 1}, none, [&](const WorkItem&, PointResult&& of_point) { result = std::move(of_point); });
  return result;
}

/// All numbers that such a scene gives.
std::vector<std::uint64_t> bits_of(const PointResult& r) {
  std::vector<std::uint64_t> bits;
  for (const double value :
       {r.x_min, r.x_max, r.v_min, r.v_max, r.period, r.period_ratio, r.velocity_ratio, r.impacts_per_period[0],
        r.impacts_per_period[1], r.rest_fraction[0], r.impacts, r.periods, r.evaluations, r.settling_estimate,
        r.observed_turns, r.end.displacement, r.end.velocity, r.end.phase})
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  bits.push_back(static_cast<std::uint64_t>(r.status)), bits.push_back(static_cast<std::uint64_t>(r.found_by));
  return bits;
}

TEST(OutOfReach, a_scene_has_the_bits_of_a_run_with_its_stops) {
  int near_resonance = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Problem scene = out_of_reach(i);
    const Effects own = effects_of(scene);
    ASSERT_FALSE(own.stops()) << i;
    Effects all = own;
    all.lower = all.upper = all.dissipation = all.rest = true;
    ASSERT_NE(effect_set_of(own), effect_set_of(all)) << i;
    const PointResult result = run_with(scene, own);
    EXPECT_EQ(result.status, steady::Status::periodic) << i;
    EXPECT_EQ(result.found_by, steady::FoundBy::closed_form) << i;
    EXPECT_EQ(bits_of(result), bits_of(run_with(scene, all))) << i;
    near_resonance += own.forcing == Forcing::secular;
  }
  EXPECT_GT(near_resonance, 20);
}

}  // namespace
}  // namespace clatter::point::out_of_reach_test
