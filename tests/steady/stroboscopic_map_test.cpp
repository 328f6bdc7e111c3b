#include "steady/stroboscopic_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::steady::stroboscopic_map_test {
namespace {

constexpr Effects effects = effect_sets::complete(Damping::light, Forcing::regular);
constexpr double ulp = std::numeric_limits<double>::epsilon();
using Integrator = stepping::Exact<double, effects>;

/// Figs. 14-23: h = 0.1, f = -1, R = 0.7.
point::Problem figure(double xs, double nu) { return support::scene_of({0.1, -1.0, nu, 0.0}, -xs, xs, 0.7); }

motion::State<double> at(double x, double v) {
  motion::State<double> state;
  state.x = x, state.v = v;
  return state;
}

/// The section some periods later.
motion::State<double> later(Integrator& integrator, motion::State<double> state, int periods) {
  stepping::NoObserver nobody;
  for (int i = 0; i < periods; ++i)
    EXPECT_EQ(advance_to_section(integrator, state, state.periods, nobody), stepping::Outcome::completed);
  return state;
}

double distance(const motion::State<double>& a, const motion::State<double>& b) { return between(a, b).size(); }

double determinant(const motion::Jacobian<double>& D) { return D[0] * D[3] - D[1] * D[2]; }

TEST(StroboscopicMap, newtons_method_finds_the_symmetric_motion_to_rounding) {
  // eq. 37: u = 0.88861376168497155; a start that is off by d gives an orbit off by d^2, the next one is off by
  // rounding
  const point::Problem scene = figure(0.5, 1.0);
  Integrator integrator(scene, limits_of(scene));
  StroboscopicMap<effects> map(integrator, 1e-12);
  const auto approach = map.follow(later(integrator, at(0, 0), 5), 1);
  ASSERT_TRUE(approach);
  ASSERT_GT(approach->gap().size(), 1e-6);  // still far away
  const auto orbit = map.attractor_of(*approach);
  ASSERT_TRUE(orbit);
  EXPECT_LE(orbit->gap().size(), 32 * ulp);  // the rounding of a period of motion
  EXPECT_LE(map.simulated(), 1u + 4 + 1);    // the approach, Newton's steps, the proof
  support::Recorder record;
  motion::State<double> state = orbit->states[0];
  ASSERT_EQ(advance_to_section(integrator, state, state.periods, record), stepping::Outcome::completed);
  ASSERT_EQ(record.impacts.size(), 2u);
  for (const motion::Event& impact : record.impacts) EXPECT_NEAR(std::abs(impact.before), 0.88861376168497155, 8 * ulp);
  // multipliers of the whole period, as given beside eq. 37
  const motion::Jacobian<double>& D = orbit->derivative();
  EXPECT_NEAR(D[0] + D[3], 0.349971948059 + 0.195257796329, 1e-10);
  EXPECT_NEAR(determinant(D), 0.349971948059 * 0.195257796329, 1e-10);
}

TEST(StroboscopicMap, a_newton_step_solves_a_linear_map_at_once) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    support::Random random(8, i);
    const auto any = [&] { return random.uniform(-2, 2); };
    const motion::Jacobian<double> D{any(), any(), any(), any()};
    const motion::Perturbation fixed{any(), any()},
        moved = D * fixed;  // by the map s -> D s + (fixed - D fixed), from 0
    const motion::Perturbation step = newton_step(D, {fixed.x - moved.x, fixed.v - moved.v});
    const double condition = 40 / std::abs((1 - D[0]) * (1 - D[3]) - D[1] * D[2]);
    EXPECT_NEAR(step.x, fixed.x, 4 * ulp * condition);
    EXPECT_NEAR(step.v, fixed.v, 4 * ulp * condition);
  }
}

/// A map with multipliers r1, r2 (or a pair of modulus r1) in a skewed basis.
motion::Jacobian<double> any_map(support::Random& random, double r1, double r2) {
  const double angle = random.uniform(0, 2 * pi<double>()), shear = random.sign() * random.logarithmic(1e-3, 1e3);
  const double c = std::cos(angle), s = std::sin(angle);
  if (random.happens(0.5)) return {r1 * c, -r1 * s * shear, r1 * s / shear, r1 * c};   // a pair
  return {r1 * c * c + r2 * s * s + shear * c * s, (r1 - r2) * c * s + shear * s * s,  // upper triangle, turned
          (r1 - r2) * c * s - shear * c * c, r1 * s * s + r2 * c * c - shear * c * s};
}

/// The largest factor, over all directions, by which a map shrinks changes, measured in a norm.
double shrinks(const motion::Jacobian<double>& D, const ContractionNorm& measure) {
  double most = 0;
  for (int k = 0; k < 64; ++k) {
    const motion::Perturbation e{std::cos(k * pi<double>() / 64), std::sin(k * pi<double>() / 64)};
    most = std::max(most, measure.of(D * e) / measure.of(e));
  }
  return most;
}

TEST(ContractionNorm, shrinks_every_change_by_half_the_contraction_of_the_larger_multiplier_or_more) {
  int tight = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    support::Random random(9, i);
    const double r = 1 - random.logarithmic(1e-6, 1), other = r * random.uniform(-1, 1);
    const motion::Jacobian<double> D = any_map(random, r, other);
    const double most = shrinks(D, ContractionNorm(D)), shear = std::abs(D[1]) + std::abs(D[2]);
    const double rounding = 1e-12 * (1 + shear) * (1 + shear) / (1 - r);
    EXPECT_LE(most, (1 + r) / 2 + rounding) << i;
    tight += most <= r * (1 + 1e-9);
  }
  EXPECT_GT(tight, 1500);  // as sharp as possible if the multipliers are well apart, or a pair
}

TEST(ContractionNorm, of_a_double_multiplier_that_couples_two_directions) {
  for (const double r : {-0.9, 0.0, 0.3, 0.999})
    for (const double coupling : {0.0, 1e-3, 1.0, 1e3})
      EXPECT_LE(shrinks({r, coupling, 0, r}, ContractionNorm({r, coupling, 0, r})), (1 + std::abs(r)) / 2 + 1e-9);
}

TEST(ContractionNorm, is_that_of_its_discs) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    support::Random random(12, i);
    const auto any = [&] { return random.uniform(-0.5, 0.5); };
    const ContractionNorm measure({any(), any(), any(), any()});
    const motion::Ellipse disc = measure.disc(0.3);
    EXPECT_NEAR(measure.of(disc) / 0.3, 1, 1e-6);
    const motion::Jacobian<double> D{any(), any(), any(), any()};
    const double most = 0.3 * shrinks(D, measure), of_disc = measure.of(disc.mapped(D));
    EXPECT_GE(of_disc, most * (1 - 1e-6));
    EXPECT_LE(of_disc, most * 1.2) << i;  // 64 directions, not all of them
  }
}

TEST(ContractionNorm, measures_changes_whose_squares_vanish_or_overflow) {
  const ContractionNorm measure({0.5, 0.3, -0.2, 0.4});
  const double size = measure.of({0.7, -0.4});
  for (const double scale : {0x1p-1000, 0x1p900}) EXPECT_EQ(measure.of({0.7 * scale, -0.4 * scale}), size * scale);
}

TEST(StroboscopicMap, an_unstable_motion_is_not_taken_for_an_attractor) {
  // at nu = 0.8 the symmetric motion between stops at -+0.34 has a multiplier of 1.6
  const point::Problem scene = figure(0.34, 0.8);
  Integrator integrator(scene, limits_of(scene));
  StroboscopicMap<effects> map(integrator, 1e-12);
  motion::State<double> symmetric = at(0.20072, -0.0738);
  std::optional<MapOrbit> orbit;
  for (int i = 0; i < 8; ++i) {
    orbit = map.follow(symmetric, 1);
    ASSERT_TRUE(orbit);
    const motion::Perturbation step = newton_step(orbit->derivative(), orbit->gap());
    symmetric = at(symmetric.x + step.x, symmetric.v + step.v);
  }
  ASSERT_LT(orbit->gap().size(), 1e-14);
  ASSERT_GT(spectral_radius(orbit->derivative()), 1.5);
  EXPECT_FALSE(map.attractor_of(*orbit));
  for (const double off : {1e-12, 1e-9, 1e-6, 1e-3})
    for (const std::size_t periods : {1u, 2u, 3u}) {
      const auto near = map.follow(at(symmetric.x + off, symmetric.v), periods);
      ASSERT_TRUE(near);
      EXPECT_FALSE(map.attractor_of(*near)) << off << ", " << periods << " periods";
    }
}

/// The outcome of starts all over a part of the plane.
struct Basin {
  int accepted = 0, refused = 0, wrong = 0;
};

Basin basin_of(const point::Problem& scene, std::uint64_t starts, double x, double v, std::size_t periods) {
  Basin basin;
  Integrator integrator(scene, limits_of(scene));
  for (std::uint64_t i = 0; i < starts; ++i) {
    support::Random random(11, i);
    StroboscopicMap<effects> map(integrator, 1e-12);
    const motion::State<double> start = at(random.uniform(-x, x), random.uniform(-v, v));
    const auto approach = map.follow(start, periods);
    const auto orbit = approach ? map.attractor_of(*approach) : std::nullopt;
    ++(orbit ? basin.accepted : basin.refused);
    if (!orbit) continue;
    EXPECT_LE(orbit->gap().size(), 1e-12 * (x + v));
    // the slowest of these contracts by a few percent a period: after 600 periods nothing of the plane's width is left
    const motion::State<double> end = later(integrator, start, 600 * static_cast<int>(periods));
    if (distance(end, orbit->states[0]) <= 1e-8) continue;
    ++basin.wrong;
    ADD_FAILURE() << "nu " << scene.oscillator.frequency << " xs " << scene.stops.upper << " from " << start.x << ", "
                  << start.v << ": " << orbit->states[0].x << " against " << end.x;
  }
  return basin;
}

TEST(StroboscopicMap, only_motion_that_ends_on_the_orbit_is_accepted) {
  // stops that resonance reaches and other motion does not: an impacting and a free motion both attract
  const point::Problem two = support::scene_of({0.05, 1.0, 1.3, 0.0}, -3, 3, 0.9);
  const Basin coexisting = basin_of(two, 400, 3.0, 4.5, 1);
  EXPECT_GT(coexisting.accepted, 20);
  EXPECT_GT(coexisting.refused, 100);
  EXPECT_EQ(coexisting.wrong, 0);
  const Basin alone = basin_of(figure(0.5, 1.0), 2000, 0.5, 2.0, 1);
  EXPECT_GT(alone.accepted, 20);
  EXPECT_GT(alone.refused, 20);
  EXPECT_EQ(alone.wrong, 0);
  EXPECT_EQ(basin_of(figure(3.0, 0.9), 200, 3.0, 3.0, 1).accepted, 0);  // chaos: nothing attracts
}

TEST(StroboscopicMap, a_motion_that_leaves_the_stops_between_its_states_is_refused) {
  // Newton's step takes a start far from any orbit beyond the stops
  const point::Problem scene = figure(0.5, 1.0);
  Integrator integrator(scene, limits_of(scene));
  StroboscopicMap<effects> map(integrator, 1e-12);
  MapOrbit approach = *map.follow(at(0.1, 0.2), 1);
  approach.states[1].x = approach.states[0].x + 100;
  EXPECT_FALSE(map.attractor_of(approach));
  approach.states[1].v = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(map.attractor_of(approach));
}

}  // namespace
}  // namespace clatter::steady::stroboscopic_map_test
