#include "steady/rounding_growth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/fifty_digits.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::steady::rounding_growth_test {
namespace {

using Integrator = stepping::Exact<double, effect_sets::complete(Damping::light, Forcing::regular)>;

/// A mass between two stops, mostly chaotic, that rests in some scenes.
point::Problem rattling(std::uint64_t i) {
  support::Random random(4104, i);
  const double R = random.uniform(0.5, 0.95);
  point::Problem scene =
      support::scene_of({random.uniform(0.01, 0.15), 1.0, random.uniform(0.6, 2.5), random.uniform(-0.5, 0.0)}, -0.1,
                        random.uniform(0.05, 0.4), R);
  scene.start.velocity = random.uniform(-1, 1);
  return scene;
}

/// The error of double is below the one that is told, and not far below: else every motion would be doubtful.
TEST(RoundingGrowth, holds_the_difference_to_fifty_digits) {
  std::vector<double> shares;
  for (std::uint64_t i = 0; i < 80; ++i) {
    const point::Problem scene = rattling(i);
    Integrator integrator(scene);
    RoundingGrowth growth(scene.stops);
    motion::State<double> state;
    state.v = scene.start.velocity;
    const int periods = 4 + static_cast<int>(i % 8);
    for (int section = 0; section < periods; ++section)
      ASSERT_EQ(advance_to_section(integrator, state, 0, growth), stepping::Outcome::completed);
    const double told = growth.largest() * epsilon<double>();
    if (!(told < 1e-4)) continue;  // beyond, it is no small change any more
    const auto exact = support::run_from<FiftyDigits>(scene, 0, scene.start.velocity, periods);
    const double size = std::max(std::abs(state.x), std::abs(state.v)),
                 error = std::max(std::abs(static_cast<double>(exact.end.x - state.x)),
                                  std::abs(static_cast<double>(exact.end.v - state.v)));
    EXPECT_LE(error, 2 * told * std::max(1.0, size)) << i;
    shares.push_back(error / told);
  }
  ASSERT_GT(shares.size(), 50);
  std::ranges::sort(shares);
  EXPECT_GT(shares[shares.size() * 3 / 4], 1e-3);
}

TEST(RoundingGrowth, is_nothing_at_rest) {
  point::Problem scene = support::scene_of({0.1, 0.2, 1.0, -1.0}, -0.5, 0.5, 0.7);
  Integrator integrator(scene);
  RoundingGrowth growth(scene.stops);
  motion::State<double> state;
  state.x = -0.5, state.from_stop = Side::lower;
  for (int section = 0; section < 3; ++section)
    ASSERT_EQ(advance_to_section(integrator, state, 0, growth), stepping::Outcome::completed);
  EXPECT_EQ(state.v, 0);
  EXPECT_EQ(growth.largest(), 0);
}

}  // namespace
}  // namespace clatter::steady::rounding_growth_test
