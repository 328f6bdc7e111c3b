// Motion between soft stops that settles in SIMD lanes, against the same motion in the scalar loop.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "lanes/alike.hpp"
#include "lanes/lane_run.hpp"

namespace clatter::lanes::cushioned_lanes_test {
namespace {

/// Every test, for every instruction set that this machine has.
class CushionedLanes : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
};

/// A random scene with soft stops that lanes accept: some without dampers, of unequal stiffness, beside a rigid stop,
/// alone, with a start beyond a stop.
point::Problem between_soft_stops(std::uint64_t index) {
  support::Random random(4713, index);
  point::Problem scene;
  std::uint64_t drawn = 1000 * index;
  do {
    scene = random_scene(drawn++);
    Stops& stops = scene.stops;
    stops.stiffness_lower = stops.stiffness_upper = random.logarithmic(0.1, 1e6);
    stops.damping_lower = stops.damping_upper = random.happens(0.2) ? 0 : random.logarithmic(1e-2, 0.9);
    if (random.happens(0.3)) stops.stiffness_upper = random.logarithmic(1, 1e4), stops.damping_upper = 0.2;
    if (random.happens(0.15)) stops.stiffness_upper = std::numeric_limits<double>::infinity(), stops.damping_upper = 0;
    if (random.happens(0.1) && std::isfinite(stops.lower))
      scene.start.displacement = stops.lower - random.uniform(0, 0.05);
  } while (!accepts(scene) || !is_soft(scene.stops, Side::lower));
  return scene;
}

std::vector<point::Problem> steady_scenes(std::uint64_t count) {
  std::vector<point::Problem> scenes;
  for (std::uint64_t i = 0; i < count; ++i) {
    scenes.push_back(observed(between_soft_stops(i)));
    scenes.back().observe.of_soft_stops = true;
    scenes.back().time.tolerance = 1e-14;  // a repeat: else the scalar loop would stop 1e-12 short of it
  }
  return scenes;
}

TEST_P(CushionedLanes, steady_motion_is_that_of_the_scalar_loop) {
  const sweep::Sweep sweep = sweep::sweep_over(steady_scenes(1000));
  const Totals totals = expect_alike(sweep, GetParam());
  EXPECT_EQ(totals.fit, totals.points);
  EXPECT_GT(totals.periodic, 700u);
  EXPECT_LT(totals.sensitive, 100u);
  EXPECT_LT(totals.chaotic, 150u);
  EXPECT_LT(totals.slow, 30u);
  EXPECT_GT(run(sweep, {.threads = 1, .arch = GetParam()}).lanes.refined, 1e5);
}

/// The contacts and the state of a run at its sections.
struct AtSection {
  double x, v, contacts;
};

/// The sections of a run in the scalar loop.
std::vector<AtSection> scalar_sections(const point::Problem& scene, std::size_t count) {
  LaneExact<cushioned> loop(scene);
  motion::State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  std::vector<AtSection> sections;
  stepping::NoObserver nobody;
  while (sections.size() < count && advance_to_section(loop, state, 0, nobody) == stepping::Outcome::completed)
    sections.push_back({state.x, state.v, loop.impacts()});
  return sections;
}

TEST_P(CushionedLanes, meet_every_contact_that_the_scalar_loop_meets_up_to_each_section) {
  constexpr std::size_t most = 40;
  std::size_t compared = 0, contacts = 0, to_scalar = 0;
  for (std::uint64_t from = 2000; from < 2480; from += LaneArray::width) {
    std::vector<point::Problem> scenes;
    for (std::uint64_t i = from; i < from + LaneArray::width; ++i) scenes.push_back(between_soft_stops(i));
    BlockState lanes{};
    std::array<std::vector<AtSection>, LaneArray::width> runs;
    for (std::size_t i = 0; i < scenes.size(); ++i)
      LaneView(lanes, i, scenes[i]).load(LaneView::Constants<cushioned>(scenes[i].oscillator), scenes[i].stops);
    LaneMask done = 0;
    for (int calls = 0; calls < 20000 && done != (LaneMask{1} << LaneArray::width) - 1; ++calls) {
      lanes.arrived = lanes.to_scalar = 0;
      step_functions_of<cushioned>(GetParam()).plain(lanes);
      for (std::size_t i = 0; i < scenes.size(); ++i) {
        const LaneMask lane = LaneMask{1} << i;
        if ((done & lane) != 0) continue;
        const LaneSection section = LaneView(lanes, i, scenes[i]).section();
        if ((lanes.arrived & lane) != 0) runs[i].push_back({section.x, section.v, section.impacts});
        if ((lanes.to_scalar & lane) != 0) ++to_scalar;
        if ((lanes.to_scalar & lane) != 0 || runs[i].size() == most) done |= lane, clear_lane(lanes, i);
      }
    }
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const std::vector<AtSection> expected = scalar_sections(scenes[i], runs[i].size());
      ASSERT_EQ(expected.size(), runs[i].size());
      std::vector<std::vector<AtSection>> others;
      for (std::uint64_t k = 0; k < 6; ++k)
        others.push_back(scalar_sections(sweep::moved(scenes[i], k), runs[i].size()));
      double size = 0, own = 0;
      for (const AtSection& s : expected) size = std::max({size, std::abs(s.x), std::abs(s.v)});
      for (std::size_t k = 0; k < runs[i].size(); ++k) {
        bool same = true;
        for (const auto& other : others) {
          same = same && other.size() > k && other[k].contacts == expected[k].contacts;
          if (same) own = std::max({own, std::abs(other[k].x - expected[k].x), std::abs(other[k].v - expected[k].v)});
        }
        if (!same || own > 1e-10 * size) break;  // roundings have grown
        const double allowed = 1e-13 * static_cast<double>(k + 1) * size + 32 * own;
        EXPECT_EQ(runs[i][k].contacts, expected[k].contacts) << from + i << ", section " << k;
        EXPECT_NEAR(runs[i][k].x, expected[k].x, allowed) << from + i << ", section " << k;
        EXPECT_NEAR(runs[i][k].v, expected[k].v, allowed) << from + i << ", section " << k;
        ++compared;
        if (k + 1 == runs[i].size()) contacts += static_cast<std::size_t>(expected[k].contacts);
      }
    }
  }
  std::cout << compared << " sections, " << contacts << " contacts; " << to_scalar
            << " of 480 went to the scalar loop\n";
  EXPECT_GT(compared, 5000u);
  EXPECT_GT(contacts, 4000u);
}

TEST_P(CushionedLanes, bits_depend_neither_on_threads_nor_on_neighbours) {
  std::vector<point::Problem> scenes = steady_scenes(200);
  const results::Dataset one = run(sweep::sweep_over(scenes), {.threads = 1, .arch = GetParam()}).dataset;
  results::expect_same(one, run(sweep::sweep_over(scenes), {.threads = 3, .arch = GetParam()}).dataset);
  std::ranges::reverse(scenes);
  const results::Dataset other = run(sweep::sweep_over(scenes), {.threads = 1, .arch = GetParam()}).dataset;
  for (const char* name : {"x_min", "x_max", "v_min", "v_max", "simulated_periods"}) {
    std::vector<double> backwards = results::values(other, name);
    std::ranges::reverse(backwards);
    const std::vector<double>& forwards = results::values(one, name);
    EXPECT_EQ(std::memcmp(forwards.data(), backwards.data(), forwards.size() * sizeof(double)), 0) << name;
  }
  const results::Dataset alone = run(sweep::sweep_over({scenes.back()}), {.threads = 1, .arch = GetParam()}).dataset;
  EXPECT_EQ(results::values(alone, "x_max")[0], results::values(one, "x_max")[0]);
}

TEST_P(CushionedLanes, a_step_with_a_nan_in_any_input_of_its_proof_is_not_proved) {
  using C = BlockState::Cushioned;
  point::Problem scene = support::scene_of({0.1, 1.0, 1.5, 0.0}, -100, 100, 0.7);
  scene.stops.stiffness_lower = scene.stops.stiffness_upper = 100, scene.stops.damping_lower = 0.1;
  std::size_t broken = 0;
  for (LaneArray C::*const row : {&C::k, &C::natural, &C::free_kb, &C::relaxation, &C::rounding_of_free}) {
    BlockState lanes{};
    for (std::size_t lane = 0; lane < LaneArray::width; ++lane)
      LaneView(lanes, lane, scene).load(LaneView::Constants<cushioned>(scene.oscillator), scene.stops);
    const std::size_t sound = broken + 1;
    (lanes.cushioned.*row).lane[broken] = std::numeric_limits<double>::quiet_NaN();
    const double left = lanes.time_to_section.lane[broken];
    step_functions_of<cushioned>(GetParam()).plain(lanes);
    EXPECT_EQ(lanes.time_to_section.lane[broken], left) << "row " << broken;
    EXPECT_TRUE(lanes.to_scalar >> broken & 1) << "row " << broken;
    EXPECT_LT(lanes.time_to_section.lane[sound], left) << "row " << broken;
    ++broken;
  }
}

TEST_P(CushionedLanes, leave_what_they_do_not_take_to_the_scalar_loop) {
  point::Problem scene = between_soft_stops(0);
  ASSERT_TRUE(accepts(scene));
  const auto refuses = [&scene](double kappa, double zeta) {
    point::Problem other = scene;
    other.oscillator = {.damping = 0.1, .forcing = 1, .frequency = 4};
    other.stops.stiffness_lower = other.stops.stiffness_upper = kappa;
    other.stops.damping_lower = other.stops.damping_upper = zeta;
    return !accepts(other);
  };
  EXPECT_FALSE(refuses(100, 0.1));
  EXPECT_TRUE(refuses(100, 0.95));  // contact creeps
  EXPECT_TRUE(refuses(15, 0.001));  // the force is in resonance with contact
  EXPECT_TRUE(refuses(1e9, 0.1));   // too stiff
  EXPECT_TRUE(refuses(0.01, 0.1));  // too weak
  EXPECT_TRUE(refuses(100, 1e-5));  // separation and the stop's position can't be told apart
  scene.oscillator.stiffness = 0;
  EXPECT_FALSE(accepts(scene));
}

TEST(CushionedBits, of_avx2_and_avx512_have_the_same_bits) {
  if (!is_supported(InstructionSet::avx512)) GTEST_SKIP() << "this machine has no avx512";
  const sweep::Sweep sweep = sweep::sweep_over(steady_scenes(300));
  results::expect_same(run(sweep, {.arch = InstructionSet::avx2}).dataset,
                       run(sweep, {.arch = InstructionSet::avx512}).dataset);
}

INSTANTIATE_TEST_SUITE_P(Of, CushionedLanes,
                         testing::Values(InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace clatter::lanes::cushioned_lanes_test
