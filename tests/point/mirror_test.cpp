// Mirrored scenes, (x, f, load) -> -(x, f, load) with the stops changing places, give mirrored results bit for bit.

#include <gtest/gtest.h>

#include "lanes/run_in_lanes.hpp"
#include "support/random.hpp"

namespace clatter::point::mirror_test {
namespace {

Problem any_scene(std::uint64_t index, steady::Mode mode) {
  support::Random random(99, index);
  Problem scene;
  scene.oscillator = {random.happens(0.1) ? 0 : random.logarithmic(1e-3, 2), random.sign() * random.logarithmic(0.1, 4),
                      random.logarithmic(0.2, 5), random.happens(0.5) ? 0 : random.uniform(-0.5, 0.5)};
  scene.stops = {-random.logarithmic(0.1, 4), random.logarithmic(0.1, 4), random.uniform(0.1, 1),
                 random.uniform(0.1, 1)};
  if (random.happens(0.5)) {
    scene.stops.upper = -scene.stops.lower;
    scene.stops.restitution_upper = scene.stops.restitution_lower;
  }
  scene.start = {0.99 * random.uniform(scene.stops.lower, scene.stops.upper), random.uniform(-2, 2),
                 random.uniform(0, 6)};
  scene.time.mode = mode, scene.time.duration = random.uniform(1, 300);
  scene.time.max_periods = 500, scene.time.max_impacts = 1e5;
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.impacts = true;
  scene.observe.period = true;
  return scene;
}

Problem mirrored(Problem scene) {
  const Stops stops = scene.stops;
  scene.stops = {-stops.upper, -stops.lower, stops.restitution_upper, stops.restitution_lower};
  for (double* const value :
       {&scene.oscillator.forcing, &scene.oscillator.load, &scene.start.displacement, &scene.start.velocity})
    *value = -*value;
  return scene;
}

PointResult result_of(const Problem& scene, lanes::InstructionSet arch) {
  ThreadScratch scratch;
  const WorkItem item{0, 0, scene, effects_of(scene)};
  if (arch == lanes::InstructionSet::scalar || !lanes::accepts(item)) return run_point(scene, scratch);
  return run_in_lanes(item, 1, arch, scratch);
}

/// Both NaN, or equal.
void expect_equal(double a, double b, std::uint64_t scene, const char* what) {
  EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)))
      << "scene " << scene << ", " << what << ": " << a << ", " << b;
}

void expect_mirrored(const PointResult& a, const PointResult& b, std::uint64_t scene) {
  EXPECT_EQ(a.status, b.status) << scene;
  expect_equal(a.impacts, b.impacts, scene, "impacts"), expect_equal(a.periods, b.periods, scene, "periods");
  expect_equal(a.x_min, -b.x_max, scene, "x_min"), expect_equal(a.x_max, -b.x_min, scene, "x_max");
  expect_equal(a.v_min, -b.v_max, scene, "v_min"), expect_equal(a.v_max, -b.v_min, scene, "v_max");
  expect_equal(a.period_ratio, b.period_ratio, scene, "period_ratio");
  expect_equal(a.velocity_ratio, b.velocity_ratio, scene, "velocity_ratio");
  for (const std::size_t stop : {0u, 1u}) {
    expect_equal(a.v_before[stop], -b.v_before[1 - stop], scene, "v_before");
    expect_equal(a.impact_speed[stop], b.impact_speed[1 - stop], scene, "impact_speed");
    expect_equal(a.v_after[stop], -b.v_after[1 - stop], scene, "v_after");
    expect_equal(a.impacts_per_period[stop], b.impacts_per_period[1 - stop], scene, "impacts_per_period");
    expect_equal(a.rest_fraction[stop], b.rest_fraction[1 - stop], scene, "rest_fraction");
  }
}

class Mirror : public testing::TestWithParam<lanes::InstructionSet> {};

TEST_P(Mirror, gives_the_same_bits) {
  if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  for (const steady::Mode mode : {steady::Mode::transient, steady::Mode::steady})
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Problem scene = any_scene(i, mode);
      expect_mirrored(result_of(scene, GetParam()), result_of(mirrored(scene), GetParam()), i);
    }
}

INSTANTIATE_TEST_SUITE_P(On, Mirror,
                         testing::Values(lanes::InstructionSet::scalar, lanes::InstructionSet::sse2,
                                         lanes::InstructionSet::avx2, lanes::InstructionSet::avx512),
                         [](const auto& which) { return std::string(name_of(which.param)); });

}  // namespace
}  // namespace clatter::point::mirror_test
