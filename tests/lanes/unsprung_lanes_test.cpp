// Points without a spring, or with an unstable one, in SIMD lanes against the same points in the scalar loop.

#include <gtest/gtest.h>

#include "lanes/alike.hpp"

namespace clatter::lanes::unsprung_lanes_test {
namespace {

/// Every test, for every instruction set that this machine has.
class UnsprungLanes : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
};

/// A random scene without a spring, or with an unstable one that presses less than the force on the stops: else the
/// mass would rest on one. The force is large enough for motion from stop to stop.
point::Problem without_spring(std::uint64_t index, double stiffness) {
  point::Problem scene = random_scene(index);
  support::Random random(4712, index);
  Oscillator& o = scene.oscillator;
  Stops& stops = scene.stops;
  o.stiffness = stiffness;
  o.damping = random.happens(0.1) ? 0 : random.logarithmic(5e-3, 0.5) * (o.stiffness == 0 ? o.frequency : 1);
  o.load *= random.happens(0.5) ? 0 : 0.3;
  const bool one_stop = !std::isfinite(stops.lower) || !std::isfinite(stops.upper);
  if (o.stiffness != 0) {
    stops.lower = std::max(stops.lower, -4.0), stops.upper = std::min(stops.upper, 4.0);
    o.forcing = random.sign() * random.uniform(1.1, 3) * (std::max(-stops.lower, stops.upper) + std::abs(o.load));
  } else if (one_stop && random.happens(0.8)) {
    o.load = std::isfinite(stops.lower) ? -0.3 : 0.3;
  }
  return scene;
}

template <class Change>
sweep::Sweep sweep_without_springs(std::uint64_t count, double stiffness, const Change& change) {
  std::vector<point::Problem> scenes;
  for (std::uint64_t i = 0; i < count; ++i) scenes.push_back(change(without_spring(i, stiffness)));
  return sweep::sweep_over(scenes);
}

TEST_P(UnsprungLanes, steady_motion_without_a_spring_is_that_of_the_scalar_loop) {
  for (const double k : {0.0, -1.0}) {
    const Totals totals = expect_alike(sweep_without_springs(500, k,
                                                             [k](const point::Problem& scene) {
                                                               point::Problem one = observed(scene);
                                                               if (k == 0) one.observe.harmonics = 0;
                                                               return one;
                                                             }),
                                       GetParam());
    EXPECT_GT(totals.fit, 400u);
    EXPECT_GT(totals.periodic, 250u);
    EXPECT_LT(totals.sensitive, 50u);
    EXPECT_LT(totals.chaotic, 200u);
    EXPECT_LT(totals.slow, 10u);
  }
}

TEST_P(UnsprungLanes, a_few_periods_without_a_spring_are_those_of_the_scalar_loop) {
  for (const double k : {0.0, -1.0}) {
    const Totals totals = expect_alike(sweep_without_springs(500, k,
                                                             [](const point::Problem& scene) {
                                                               point::Problem one = transient(scene, 1);
                                                               one.time.duration = 20;
                                                               return one;
                                                             }),
                                       GetParam());
    EXPECT_GT(totals.fit, 400u);
    EXPECT_LT(totals.sensitive + totals.chaotic, 200u);
  }
}

TEST_P(UnsprungLanes, springs_of_every_kind_can_be_followed_through) {
  // with k from -0.5 to 0.5 the kind of lanes changes along a branch, and with the branches of R others wait meanwhile
  sweep::Axis k{Parameter("stiffness"), {}}, R{Parameter("R"), {}};
  for (int i = -10; i <= 10; ++i) k.values.push_back(i / 20.0);
  for (int i = 0; i < 40; ++i) R.values.push_back(0.5 + i / 200.0);
  point::Problem scene = observed(sweep::paper_scene(0.5, 2.0));
  scene.observe.harmonics = 0;
  for (const bool follow : {true, false}) {
    sweep::Sweep sweep = sweep::sweep_of(scene, {R, k});
    if (follow) sweep.follow = 1;
    const sweep::RunResult result = run(sweep, {.threads = 1, .arch = GetParam()});
    results::expect_same(result.dataset, run(sweep, {.threads = 3, .arch = GetParam()}).dataset);
    EXPECT_GT(result.lanes.refined, 1000);
    const results::Dataset scalar = run(sweep, {.threads = 1, .arch = InstructionSet::scalar}).dataset;
    for (std::size_t i = 0; i < size(sweep); ++i)  // a repeat to 1e-12
      EXPECT_LE(sweep::compare({result.dataset, i}, {scalar, i}).by, 1e-11) << i << ' ' << follow;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, UnsprungLanes,
                         testing::Values(InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace clatter::lanes::unsprung_lanes_test
