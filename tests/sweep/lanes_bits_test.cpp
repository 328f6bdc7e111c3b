// Which bits a point in SIMD lanes has: they depend neither on threads nor on neighbours, and on the instruction set
// only where one rounds a product that another doesn't.

#include <gtest/gtest.h>

#include <iostream>
#include <numeric>

#include "hard/any_scene.hpp"
#include "sweep/two_runs.hpp"

namespace clatter {
namespace {

/// Motion of all kinds, all that lanes observe.
std::vector<Scene> scenes_of_all_kinds(Mode mode) {
  std::vector<Scene> scenes;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Scene scene = hard::any_scene(i).scene;
    scene.time = {.mode = mode, .max_periods = 200, .duration = 50.3, .max_impacts = 1e4};
    scene.observe = {
        .extrema = true, .harmonics = 3, .harmonics_method = HarmonicsMethod::exact, .impacts = true, .period = true};
    scenes.push_back(scene);
  }
  for (int i = 0; i < 100; ++i) {
    Scene scene = scenes.front();
    const Scene paper = paper_scene(3.0, 0.85 + i / 1000.0);
    scene.oscillator = paper.oscillator, scene.stops = paper.stops, scene.start = paper.start;
    scenes.push_back(scene);
  }
  return scenes;
}

/// The bits of a point in all variables, what it took included.
void expect_same_point(const Figure& a, std::size_t i, const Figure& b, std::size_t j) {
  const std::size_t points = statuses(a).size(), others = statuses(b).size();
  for (const Variable& variable : b.variables) {
    const Variable* const same = find(a, variable.name);
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

class LaneBits : public testing::TestWithParam<Arch> {
 protected:
  void SetUp() override {
    if (!runs_here(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
  [[nodiscard]] Figure lanes(const Sweep& sweep, int threads = 1) const {
    return run(sweep, {.threads = threads, .arch = GetParam()}).figure;
  }
};

TEST_P(LaneBits, are_the_same_for_every_number_of_threads) {
  for (const Mode mode : {Mode::steady, Mode::transient}) {
    const Sweep sweep = sweep_over(scenes_of_all_kinds(mode));
    const Figure one = lanes(sweep);
    for (const int threads : {2, 4}) expect_same(one, lanes(sweep, threads));
  }
}

TEST_P(LaneBits, are_the_same_beside_other_neighbours) {
  for (const Mode mode : {Mode::steady, Mode::transient}) {
    const std::vector<Scene> scenes = scenes_of_all_kinds(mode);
    const Figure figure = lanes(sweep_over(scenes));
    std::vector<std::size_t> order(scenes.size());
    std::iota(order.rbegin(), order.rend(), 0u);  // from the last to the first
    for (int round = 0; round < 2; ++round) {
      std::vector<Scene> others;
      for (const std::size_t i : order) others.push_back(scenes[i]);
      const Figure other = lanes(sweep_over(others));
      for (std::size_t j = 0; j < order.size(); ++j) expect_same_point(figure, order[j], other, j);
      std::shuffle(order.begin(), order.end(), std::mt19937_64(7));
    }
  }
}

TEST_P(LaneBits, are_the_same_alone_and_in_parts_of_a_sweep) {
  for (const Mode mode : {Mode::steady, Mode::transient}) {
    const std::vector<Scene> scenes = scenes_of_all_kinds(mode);
    const Figure figure = lanes(sweep_over(scenes));
    for (std::size_t i = 0; i < scenes.size(); i += 3) expect_same_point(figure, i, lanes(sweep_of(scenes[i], {})), 0);
    for (const std::size_t begin : {std::size_t{0}, std::size_t{17}, scenes.size() - 50}) {
      const auto first = scenes.begin() + static_cast<std::ptrdiff_t>(begin);
      const Figure part = lanes(sweep_over({first, first + 50}));
      for (std::size_t j = 0; j < 50; ++j) expect_same_point(figure, begin + j, part, j);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, LaneBits, testing::Values(Arch::sse2, Arch::avx2, Arch::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

TEST(LaneBits, are_the_same_by_avx2_and_avx512_which_both_fuse_products_and_sums) {
  if (!runs_here(Arch::avx512)) GTEST_SKIP() << "this machine has no avx512";
  for (const Mode mode : {Mode::steady, Mode::transient}) {
    const Sweep sweep = sweep_over(scenes_of_all_kinds(mode));
    expect_same(run(sweep, {.arch = Arch::avx2}).figure, run(sweep, {.arch = Arch::avx512}).figure);
  }
}

}  // namespace
}  // namespace clatter
