// The bits of a point in SIMD lanes: they depend neither on threads nor on neighbours, and on the instruction set only
// if one rounds a product that another doesn't.

#include <gtest/gtest.h>

#include <iostream>
#include <numeric>

#include "hard/any_scene.hpp"
#include "sweep/two_runs.hpp"

namespace clatter::lanes::lanes_bits_test {
namespace {

/// Motion of all kinds, with every observable of lanes.
std::vector<point::Problem> scenes_of_all_kinds(steady::Mode mode) {
  std::vector<point::Problem> scenes;
  for (std::uint64_t i = 0; i < 300; ++i) {
    point::Problem scene = hard::any_scene(i).scene;
    scene.time = {.mode = mode, .max_periods = 200, .duration = 50.3, .max_impacts = 1e4};
    scene.observe = {};
    scene.observe.extrema = true;
    scene.observe.harmonics = 3;
    scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
    scene.observe.impacts = true;
    scene.observe.period = true;
    scenes.push_back(scene);
  }
  for (int i = 0; i < 100; ++i) {
    point::Problem scene = scenes.front();
    const point::Problem paper = sweep::paper_scene(3.0, 0.85 + i / 1000.0);
    scene.oscillator = paper.oscillator, scene.stops = paper.stops, scene.start = paper.start;
    scenes.push_back(scene);
    scene.oscillator.stiffness = i % 2 == 0 ? 0 : -1;  // between walls, with lanes of their own
    scene.oscillator.forcing = 4, scene.stops = {-1, 1, 0.8, 0.8};
    scenes.push_back(scene);
  }
  return scenes;
}

/// Compares the bits of a point in all variables, its work included.
void expect_same_point(const results::Dataset& a, std::size_t i, const results::Dataset& b, std::size_t j) {
  const std::size_t points = statuses(a).size(), others = statuses(b).size();
  for (const results::Variable& variable : b.variables) {
    const results::Variable* const same = find(a, variable.name);
    if (!same) continue;  // a coordinate
    std::visit(
        [&](const auto& right) {
          const auto& left = std::get<std::decay_t<decltype(right)>>(same->values);
          const std::size_t width = right.size() / others;
          if (width * points != left.size()) return;  // a coordinate of its own
          EXPECT_EQ(std::memcmp(left.data() + i * width, right.data() + j * width, width * sizeof(right[0])), 0)
              << variable.name << " of " << i;
        },
        variable.values);
  }
}

class LaneBits : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
  [[nodiscard]] results::Dataset lanes(const sweep::Sweep& sweep, int threads = 1) const {
    return run(sweep, {.threads = threads, .arch = GetParam()}).dataset;
  }
};

TEST_P(LaneBits, are_the_same_for_every_number_of_threads) {
  for (const steady::Mode mode : {steady::Mode::steady, steady::Mode::transient}) {
    const sweep::Sweep sweep = sweep::sweep_over(scenes_of_all_kinds(mode));
    const results::Dataset one = lanes(sweep);
    for (const int threads : {2, 4}) expect_same(one, lanes(sweep, threads));
  }
}

TEST_P(LaneBits, are_the_same_beside_other_neighbours) {
  for (const steady::Mode mode : {steady::Mode::steady, steady::Mode::transient}) {
    const std::vector<point::Problem> scenes = scenes_of_all_kinds(mode);
    const results::Dataset dataset = lanes(sweep::sweep_over(scenes));
    std::vector<std::size_t> order(scenes.size());
    std::iota(order.rbegin(), order.rend(), 0u);  // from the last to the first
    for (int round = 0; round < 2; ++round) {
      std::vector<point::Problem> others;
      for (const std::size_t i : order) others.push_back(scenes[i]);
      const results::Dataset other = lanes(sweep::sweep_over(others));
      for (std::size_t j = 0; j < order.size(); ++j) expect_same_point(dataset, order[j], other, j);
      std::shuffle(order.begin(), order.end(), std::mt19937_64(7));
    }
  }
}

TEST_P(LaneBits, are_the_same_alone_and_in_parts_of_a_sweep) {
  for (const steady::Mode mode : {steady::Mode::steady, steady::Mode::transient}) {
    const std::vector<point::Problem> scenes = scenes_of_all_kinds(mode);
    const results::Dataset dataset = lanes(sweep::sweep_over(scenes));
    for (std::size_t i = 0; i < scenes.size(); i += 3)
      expect_same_point(dataset, i, lanes(sweep::sweep_of(scenes[i], {})), 0);
    for (const std::size_t begin : {std::size_t{0}, std::size_t{17}, scenes.size() - 50}) {
      const auto first = scenes.begin() + static_cast<std::ptrdiff_t>(begin);
      const results::Dataset part = lanes(sweep::sweep_over({first, first + 50}));
      for (std::size_t j = 0; j < 50; ++j) expect_same_point(dataset, begin + j, part, j);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, LaneBits,
                         testing::Values(InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

TEST(LaneBits, are_the_same_by_avx2_and_avx512_which_both_fuse_products_and_sums) {
  if (!is_supported(InstructionSet::avx512)) GTEST_SKIP() << "this machine has no avx512";
  for (const steady::Mode mode : {steady::Mode::steady, steady::Mode::transient}) {
    const sweep::Sweep sweep = sweep::sweep_over(scenes_of_all_kinds(mode));
    results::expect_same(run(sweep, {.arch = InstructionSet::avx2}).dataset,
                         run(sweep, {.arch = InstructionSet::avx512}).dataset);
  }
}

}  // namespace
}  // namespace clatter::lanes::lanes_bits_test
