#include "motion/rough_neighbourhood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "motion/watched_run.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::motion::rough_neighbourhood_test {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon(), none = std::numeric_limits<double>::infinity();

/// A random scene with friction, its start and an ellipse around it.
struct Case {
  point::Problem scene;
  State<double> from;
  double turns, size, skew, wide;

  [[nodiscard]] Ellipse ellipse() const { return {size * size * wide, size * size * skew, size * size / wide}; }
  /// A change on the ellipse, or half as far: L (cos, sin) with its Cholesky factor L.
  [[nodiscard]] Perturbation change(int k) const {
    const double angle = 2 * pi<double>() * k / 24, reach = k % 3 == 0 ? 0.5 : 1.0;
    const double along = reach * std::cos(angle), across = reach * std::sin(angle);
    return {size * std::sqrt(wide) * along,
            size * (skew / std::sqrt(wide) * along + std::sqrt((1 - skew * skew) / wide) * across)};
  }
};

Case any_case(std::uint64_t seed, std::uint64_t i) {
  support::Random random(seed, i);
  const double g = random.logarithmic(0.2, 3), nu = random.logarithmic(0.3, 3);
  const double h = random.happens(0.3) ? 0 : random.logarithmic(1e-4, 0.8);
  Case any;
  any.scene = support::scene_of({h, 1.0, nu, random.uniform(-0.2, 0.2)}, -g, g * random.uniform(0.5, 2), 0);
  const double kinetic = random.happens(0.1) ? 0 : random.logarithmic(1e-4, 0.6);
  any.scene.friction = {kinetic, random.happens(0.5) ? kinetic : kinetic * random.uniform(1, 2) + 1e-3};
  Stops& stops = any.scene.stops;
  stops.restitution_lower = random.uniform(0.2, 1), stops.restitution_upper = random.uniform(0.2, 1);
  if (random.happens(0.3))
    stops.stiffness_lower = random.logarithmic(1.2, 1e4),
    stops.damping_lower = random.happens(0.5) ? 0 : random.uniform(0, 1);
  if (random.happens(0.3))
    stops.stiffness_upper = random.logarithmic(1.2, 1e4),
    stops.damping_upper = random.happens(0.5) ? 0 : random.uniform(0, 1);
  if (random.happens(0.2)) stops.upper = none;
  any.from = at(random.uniform(-0.9 * g, 0.4 * g), random.uniform(-2, 2));
  any.turns = random.uniform(0.3, 2.5), any.size = random.logarithmic(1e-9, 1e-1);
  any.skew = random.uniform(-0.9, 0.9), any.wide = random.logarithmic(0.3, 3);
  return any;
}

/// Turns back within a change of where it would stick.
Case halting_case(std::uint64_t seed, std::uint64_t i) {
  Case any = any_case(seed, i);
  support::Random random(seed + 1, i);
  any.scene.friction.static_level = random.uniform(0.6, 1.2);
  any.scene.friction.kinetic = random.uniform(0.1, 0.6);
  any.size = random.logarithmic(1e-4, 1e-1);
  return any;
}

constexpr Effects effects = effect_sets::with_friction(Damping::light, Forcing::secular);

/// Counts the reversals of a motion.
struct Reversals {
  int count = 0;

  template <class A>
  void arc(const A&, double, double) {}
  void event(const Event& event) { count += event.kind == Event::Kind::reversal; }
};

int reversals_of(const Case& any) {
  stepping::Exact<double, effects> integrator(any.scene);
  Reversals reversals;
  State<double> state = any.from;
  return run_for(integrator, state, any.turns, reversals) == stepping::Outcome::completed ? reversals.count : 0;
}

RoughNeighbourhood neighbourhood_of(const Case& any) {
  stepping::Exact<double, effects> integrator(any.scene);
  const double rounding = 64 * ulp * (std::abs(any.from.x) + std::abs(any.from.v));
  RoughNeighbourhood neighbourhood(any.scene.stops, any.ellipse(), rounding, any.scene.friction.static_level);
  State<double> state = any.from;
  EXPECT_EQ(run_for(integrator, state, any.turns, neighbourhood), stepping::Outcome::completed);
  return neighbourhood;
}

/// Number of proofs that were found, and the tightness of their enclosures.
struct Tally {
  int proved = 0, refused = 0, reversals = 0;
  double tightest = 0;  ///< the largest remainder beyond the derivative, over its enclosure
};

/// Each motion that begins on the ellipse has the events of the observed one in their order, and is where the proof
/// says; `tally` counts.
void expect_enclosed(const Case& any, std::uint64_t i, Tally& tally) {
  const std::optional<Run> seen = run<effects>(any.scene, any.from, any.turns);
  const RoughNeighbourhood proof = neighbourhood_of(any);
  if (!seen || !proof.holds()) {
    ++tally.refused;
    return;
  }
  ++tally.proved, tally.reversals += reversals_of(any);
  for (int k = 0; k < 24; ++k) {
    const Perturbation change = any.change(k);
    const std::optional<Run> other =
        run<effects>(any.scene, at(any.from.x + change.x, any.from.v + change.v), any.turns);
    ASSERT_TRUE(other) << i;
    EXPECT_EQ(other->itinerary, seen->itinerary) << i << " change " << any.size;
    const Perturbation linear = seen->derivative * change, real = between(seen->end, other->end);
    double rounding = 2;
    for (const double entry : seen->derivative) rounding += std::abs(entry);
    rounding *= 256 * ulp * (1 + std::abs(any.from.x) + std::abs(any.from.v));
    EXPECT_LE(std::abs(real.x - linear.x), proof.remainder().x() + rounding) << i << " change " << any.size;
    EXPECT_LE(std::abs(real.v - linear.v), proof.remainder().v() + rounding) << i << " change " << any.size;
    EXPECT_LE(std::abs(linear.x), proof.first_order().x() * (1 + 1e-9) + rounding) << i;
    EXPECT_LE(std::abs(linear.v), proof.first_order().v() * (1 + 1e-9) + rounding) << i;
    if (proof.remainder().v() > 1e3 * rounding)
      tally.tightest = std::max(tally.tightest, std::abs(real.v - linear.v) / proof.remainder().v());
  }
}

TEST(RoughNeighbourhood, encloses_all_motions_that_begin_in_it) {
  Tally tally;
  for (std::uint64_t i = 0; i < 2000; ++i) expect_enclosed(any_case(31, i), i, tally);
  EXPECT_GT(tally.proved, 300);
  EXPECT_GT(tally.refused, 300);  // large changes, grazes, rests, sticks
  EXPECT_GT(tally.reversals, 300);
  EXPECT_GT(tally.tightest, 0.05);  // the bounds aren't far from the remainders
}

TEST(RoughNeighbourhood, does_not_hold_if_some_of_the_motions_stick) {
  Tally tally;
  for (std::uint64_t i = 0; i < 2000; ++i) expect_enclosed(halting_case(32, i), i, tally);
  EXPECT_GT(tally.proved, 50);
  EXPECT_GT(tally.reversals, 50);
}

}  // namespace
}  // namespace clatter::motion::rough_neighbourhood_test
