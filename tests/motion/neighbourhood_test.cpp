#include "motion/neighbourhood.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "motion/watched_run.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::motion::neighbourhood_test {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();

template <Effects effects>
Neighbourhood neighbourhood_of(const point::Problem& scene, State<double> state, double turns, const Ellipse& start) {
  stepping::Exact<double, effects> integrator(scene);
  Neighbourhood neighbourhood(scene.stops, start, 64 * ulp * (std::abs(state.x) + std::abs(state.v)));
  EXPECT_EQ(run_for(integrator, state, turns, neighbourhood), stepping::Outcome::completed);
  return neighbourhood;
}

/// Number of proofs that were found, and the tightness of their enclosures.
struct Tally {
  int proved = 0, refused = 0, with_impacts = 0;
  double tightest = 0;  ///< the largest remainder beyond the derivative, over its enclosure

  void take(double share) { tightest = std::max(tightest, share); }
};

double any_restitution(support::Random& random) { return random.uniform(0.2, 1); }
/// So little that the force alone takes the mass away from the stop.
double hardly_any_restitution(support::Random& random) {
  return random.happens(0.5) ? 0 : random.logarithmic(1e-12, 1e-3);
}

/// Random motions between stops, and around each of them motions that begin on an ellipse.
template <Effects effects>
Tally enclose(std::uint64_t seed, double least_h, double most_h,
              double (*restitution)(support::Random&) = any_restitution) {
  Tally tally;
  for (std::uint64_t i = 0; i < 600; ++i) {
    support::Random random(seed, i);
    const double g = random.logarithmic(0.2, 2), nu = random.logarithmic(0.3, 3),
                 h = random.logarithmic(least_h, most_h);
    point::Problem scene =
        support::scene_of({h, 1.0, nu, random.uniform(-0.2, 0.2)}, -g, g * random.uniform(0.5, 2), 0);
    scene.stops.restitution_lower = restitution(random), scene.stops.restitution_upper = restitution(random);
    const State<double> from = at(random.uniform(-0.9 * g, 0.4 * g), random.uniform(-2, 2));
    const double turns = random.uniform(0.5, 3), size = random.logarithmic(1e-9, 1e-1);
    const double skew = random.uniform(-0.9, 0.9), wide = random.logarithmic(0.3, 3);
    const Ellipse start(size * size * wide, size * size * skew, size * size / wide);
    const std::optional<Run> seen = run<effects>(scene, from, turns);
    const Neighbourhood proof = neighbourhood_of<effects>(scene, from, turns, start);
    if (!seen || !proof.holds()) {
      ++tally.refused;
      continue;
    }
    ++tally.proved, tally.with_impacts += seen->itinerary != 0;
    for (int k = 0; k < 24; ++k) {
      const double angle = 2 * pi<double>() * k / 24, reach = k % 3 == 0 ? 0.5 : 1.0;
      const double a = reach * std::sqrt(wide) * size, along = reach * std::cos(angle),
                   across = reach * std::sin(angle);
      // L (cos, sin) with the Cholesky factor L of the ellipse
      const Perturbation change{a * along / reach,
                                size * (skew / std::sqrt(wide) * along + std::sqrt((1 - skew * skew) / wide) * across)};
      const std::optional<Run> other = run<effects>(scene, at(from.x + change.x, from.v + change.v), turns);
      EXPECT_TRUE(other) << i;
      if (!other) continue;
      EXPECT_EQ(other->itinerary, seen->itinerary) << i;
      const Perturbation linear = seen->derivative * change, real = between(seen->end, other->end);
      const double rounding = 256 * ulp *
                              (2 + std::abs(seen->derivative[0]) + std::abs(seen->derivative[1]) +
                               std::abs(seen->derivative[2]) + std::abs(seen->derivative[3]));
      EXPECT_LE(std::abs(real.x - linear.x), proof.remainder().x() + rounding) << i << " change " << size;
      EXPECT_LE(std::abs(real.v - linear.v), proof.remainder().v() + rounding) << i << " change " << size;
      EXPECT_LE(std::abs(linear.x), proof.first_order().x() * (1 + 1e-9) + rounding) << i;
      EXPECT_LE(std::abs(linear.v), proof.first_order().v() * (1 + 1e-9) + rounding) << i;
      if (proof.remainder().v() > 1e3 * rounding) tally.take(std::abs(real.v - linear.v) / proof.remainder().v());
    }
  }
  return tally;
}

void expect_proofs(const Tally& tally) {
  EXPECT_GT(tally.proved, 150);
  EXPECT_GT(tally.refused, 50);  // large changes, grazes, rests
  EXPECT_GT(tally.with_impacts, 50);
  EXPECT_GT(tally.tightest, 0.1);  // the bounds aren't far from the remainders
}

/// A proof on one side and the other of an instant.
template <Effects effects>
bool holds_in_two(const point::Problem& scene, State<double> state, double cut, double turns, double size) {
  stepping::Exact<double, effects> integrator(scene);
  Neighbourhood neighbourhood(scene.stops, Ellipse::disc(size), 64 * ulp, false, pace_of(scene.oscillator));
  EXPECT_EQ(run_for(integrator, state, cut, neighbourhood), stepping::Outcome::completed);
  EXPECT_EQ(run_for(integrator, state, turns - cut, neighbourhood), stepping::Outcome::completed);
  return neighbourhood.holds();
}

/// Where the force is far faster than the spring, differences grow in a flight, and are larger in an arc that lasts.
TEST(Neighbourhood, a_section_just_after_an_impact_takes_no_proof) {
  constexpr Effects effects = effect_sets::complete(Damping::light, Forcing::regular);
  int held = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    support::Random random(97, i);
    const double nu = random.uniform(5, 50), unit = nu * nu;
    point::Problem scene = support::scene_of({1e-3, unit * random.uniform(0.1, 0.4), nu, -0.1 * unit}, 0, 1e3, 0);
    scene.stops.restitution_lower = random.uniform(0.3, 0.9);
    const State<double> from = at(random.uniform(0.1, 0.5), nu * random.uniform(-1, 1));
    const double turns = 1.5, size = 1e-13;
    stepping::Exact<double, effects> integrator(scene);
    support::Recorder log;
    State<double> state = from;
    ASSERT_EQ(run_for(integrator, state, turns, log), stepping::Outcome::completed) << i;
    if (log.impacts.empty()) continue;
    const double at_impact = log.impacts.front().time / integrator.period();
    if (!holds_in_two<effects>(scene, from, 0.5 * at_impact, turns, size)) continue;
    ++held;
    for (double later = 1e-15; later < 1e-3; later *= 1.7)
      EXPECT_TRUE(holds_in_two<effects>(scene, from, at_impact + later, turns, size)) << i << ' ' << later;
  }
  EXPECT_GT(held, 50);
}

TEST(Neighbourhood, encloses_all_motions_that_begin_in_it) {
  expect_proofs(enclose<effect_sets::complete(Damping::light, Forcing::regular)>(21, 1e-4, 0.8));
  expect_proofs(enclose<effect_sets::complete(Damping::light, Forcing::secular)>(22, 1e-4, 0.06));
  expect_proofs(enclose<effect_sets::complete(Damping::heavy, Forcing::regular)>(23, 1, 4));
}

TEST(Neighbourhood, encloses_motions_that_the_force_takes_away_from_an_inelastic_stop) {
  const Tally tally =
      enclose<effect_sets::complete(Damping::light, Forcing::regular)>(24, 1e-4, 0.8, hardly_any_restitution);
  EXPECT_GT(tally.with_impacts, 50);
}

TEST(Neighbourhood, a_flight_that_comes_near_a_stop_without_touching_it_is_proved_up_to_its_gap) {
  // the steady motion of amplitude A with a stop at A (1 + gap): motions within that gap of it don't touch the stop
  constexpr Effects effects = effect_sets::complete(Damping::light, Forcing::regular);
  const Oscillator oscillator{0.1, 1.0, 1.5, 0.0};
  const double A = 0.777909841584413976, gap = 1e-6;
  const point::Problem scene = support::scene_of(oscillator, -1.0, A * (1 + gap), 0.7);
  const State<double> steady = at(-0.181543116490166415, -1.13464447806354009);
  EXPECT_TRUE(neighbourhood_of<effects>(scene, steady, 1, Ellipse::disc(0.9 * A * gap)).holds());
  EXPECT_FALSE(neighbourhood_of<effects>(scene, steady, 1, Ellipse::disc(1.1 * A * gap)).holds());
}

TEST(Neighbourhood, nothing_is_proved_of_a_graze_a_rest_or_a_start_on_its_way_into_a_stop) {
  constexpr Effects effects = effect_sets::complete(Damping::light, Forcing::regular);
  const double A = 0.777909841584413976;
  const State<double> steady = at(-0.181543116490166415, -1.13464447806354009);
  const point::Problem graze = support::scene_of({0.1, 1.0, 1.5, 0.0}, -A * (1 - 1e-10), 2.0, 0.7);
  const point::Problem rest = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5);
  const point::Problem free = support::scene_of({0.1, 1.0, 1.5, 0.0}, -1.0, 1.0, 0.7);
  const Ellipse changes = Ellipse::disc(1e-9);
  EXPECT_FALSE(neighbourhood_of<effects>(graze, steady, 1, changes).holds());
  EXPECT_FALSE(neighbourhood_of<effects>(rest, at(0, 0), 1, changes).holds());
  EXPECT_FALSE(neighbourhood_of<effects>(free, at(1 - 1e-10, 1), 0.1, changes).holds());
  EXPECT_FALSE(neighbourhood_of<effects>(free, at(1 - 1e-10, -1e-9), 0.1, changes).holds());
  EXPECT_TRUE(neighbourhood_of<effects>(free, at(1 - 1e-10, -1), 0.1, changes).holds());  // it moves away from the stop
}

TEST(Ellipse, holds_the_images_and_sums_of_its_changes) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    support::Random random(24, i);
    const auto any = [&] { return random.uniform(-2, 2); };
    const auto unit = [&] {
      const double angle = random.uniform(0, 2 * pi<double>());
      return Perturbation{std::cos(angle), std::sin(angle)};
    };
    const Jacobian<double> D{any(), any(), any(), any()}, F{any(), any(), any(), any()};
    Ellipse sum = Ellipse::disc(1).mapped(D);
    const Ellipse other = Ellipse::disc(0.3).mapped(F);
    sum.add(other);
    for (int k = 0; k < 50; ++k) {
      const Perturbation d = D * unit(), f = F * unit(), both{d.x + 0.3 * f.x, d.v + 0.3 * f.v};
      EXPECT_LE(std::abs(both.x), sum.x() * (1 + 8 * ulp));
      EXPECT_LE(std::abs(both.v), sum.v() * (1 + 8 * ulp));
      EXPECT_LE(std::hypot(both.x, both.v), sum.size() * (1 + 8 * ulp));
    }
  }
}

}  // namespace
}  // namespace clatter::motion::neighbourhood_test
