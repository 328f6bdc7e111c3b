#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sweep/figures.hpp"
#include "sweep/mirror_images.hpp"

namespace clatter::sweep::mirror_images_test {
namespace {

/// Starts around the origin at phases all round, of a scene with two motions.
Sweep starts() {
  point::Problem scene = paper_scene(0.5, 3.0);
  scene.observe = {};
  scene.observe.extrema = scene.observe.settling = scene.observe.attractor = scene.observe.stability = true;
  return sweep_of(scene, {{Parameter("x0"), {-0.4, -0.2, 0, 0.2, 0.4}},
                          {Parameter("v0"), {-1.5, -0.5, 0.5, 1.5}},
                          {Parameter("phase"), {0, 0.5, M_PI / 2, M_PI, M_PI + 0.5, 3 * M_PI / 2}}});
}

TEST(MirrorImages, are_pairs) {
  const Sweep sweep = starts();
  const MirrorImages images(sweep);
  EXPECT_EQ(images.count(), 60);
  for (std::size_t point = 0; point < size(sweep); ++point) {
    const auto image = images.image_of(point);
    ASSERT_TRUE(image);
    EXPECT_EQ(images.image_of(*image), point);
    EXPECT_EQ(images.original_of(point).has_value(), *image < point);
    const point::Problem here = problem_at(sweep, point), there = problem_at(sweep, *image);
    EXPECT_EQ(here.start.displacement, -there.start.displacement);
    EXPECT_EQ(here.start.velocity, -there.start.velocity);
    EXPECT_NEAR(std::abs(here.start.phase - there.start.phase), M_PI, 1e-15);
  }
}

/// The same starts with another observable, which has every point run.
TEST(MirrorImages, have_the_results_of_a_run_of_their_own) {
  Sweep sweep = starts();
  const RunResult halved = run(sweep, {.threads = 2});
  sweep.problem.observe.period = true;
  EXPECT_FALSE(MirrorImages(sweep).exist());
  const RunResult whole = run(sweep, {.threads = 2});
  double points = 0;
  for (const WorkStats& work : halved.work) points += static_cast<double>(work.points);
  EXPECT_EQ(points, 60);
  const auto numbers = [](const RunResult& result) {
    return std::get<std::vector<std::int32_t>>(find(result.dataset, "attractor")->values);
  };
  EXPECT_EQ(numbers(halved), numbers(whole));
  for (const std::string name : {"x_min", "x_max", "v_min", "v_max", "settling_periods", "lyapunov"}) {
    const std::vector<double>&a = values(halved.dataset, name), &b = values(whole.dataset, name);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9) << name << ' ' << i;
  }
}

TEST(MirrorImages, need_symmetric_scenes_and_starts) {
  const std::vector<std::function<void(Sweep&)>> changes{
      [](Sweep& s) { s.problem.oscillator.load = 0.1; },
      [](Sweep& s) { s.problem.stops.upper = 0.6; },
      [](Sweep& s) { s.problem.stops.restitution_upper = 0.6; },
      [](Sweep& s) { s.problem.observe.harmonics = 3; },
      [](Sweep& s) { s.problem.time.mode = steady::Mode::transient; },
      [](Sweep& s) { s.problem.integration.all_effects = true; },
      [](Sweep& s) { s.dimensions[0][0].values[1] = -0.3; },
      [](Sweep& s) { s.dimensions[2][0].values[1] = 0.6; },
      [](Sweep& s) { s.dimensions.erase(s.dimensions.begin() + 2); },
      [](Sweep& s) { s.dimensions.erase(s.dimensions.begin()), s.problem.start.displacement = 0.1; },
      [](Sweep& s) {
        s.dimensions.push_back({{Parameter("load"), {0, 0.1}}});
      },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Sweep sweep = starts();
    changes[i](sweep);
    EXPECT_FALSE(MirrorImages(sweep).exist()) << i;
  }
  Sweep free = starts();  // without a force at any time
  free.problem.oscillator.forcing = 0;
  free.dimensions.pop_back();
  EXPECT_EQ(MirrorImages(free).count(), 10);
  Sweep parameters = starts();
  parameters.dimensions.insert(parameters.dimensions.begin(), {{Parameter("nu"), {2, 3}}});
  EXPECT_EQ(MirrorImages(parameters).count(), 120);
}

/// A restored point can't give its result to its mirror image any more, which is then run by itself: with the same
/// bits.
TEST(MirrorImages, of_restored_points_are_run) {
  const Sweep sweep = starts();
  const results::Dataset whole = run(sweep, {.threads = 1}).dataset;
  SweepRun first(sweep);
  first.run({.threads = 1});
  std::vector<std::byte> pieces;
  first.save([&](std::span<const std::byte> results) { pieces.insert(pieces.end(), results.begin(), results.end()); });
  for (const std::size_t share : {2UL, 3UL, 7UL}) {
    SweepRun second(sweep);
    ASSERT_TRUE(second.restore(std::span(pieces).first(pieces.size() / size(sweep) * (size(sweep) / share))));
    EXPECT_EQ(second.restored_points(), size(sweep) / share);
    second.run({.threads = 2});
    expect_same(whole, dataset_of(second));
  }
}

}  // namespace
}  // namespace clatter::sweep::mirror_images_test
