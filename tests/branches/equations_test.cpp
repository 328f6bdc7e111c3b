#include "branches/equations/equations.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "branches/equations/newton.hpp"
#include "branches/walk/violation.hpp"
#include "math/dual.hpp"
#include "math/fifty_digits.hpp"

namespace clatter::branches::equations_test {
namespace {

Scene symmetric_scene(double h, double f, double nu, double R, double xs) {
  Scene scene;
  scene.oscillator = {h, f, nu, 0.0};
  scene.stops = {-xs, xs, R, R};
  return scene;
}

Scene random_scene(std::mt19937& random) {
  const auto in = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  return symmetric_scene(in(0.0, 1.0) < 0.2 ? in(1.05, 2.0) : in(0.0, 0.5), in(0.3, 2.0), in(0.3, 4.0), in(0.1, 0.98),
                         in(0.1, 2.0));
}

/// Symmetric motion with one impact on each stop and period in closed form (Masri and Caughey 1966; Shaw 1985), in 50
/// digits: alpha u - g and gamma u are components of the response at an impact of speed u.
template <Effects E>
struct HalfPeriod {
  using N = FiftyDigits;
  explicit HalfPeriod(const Scene& scene)
      : R(scene.stops.restitution_upper.R),
        g(scene.stops.upper),
        c(scene.oscillator),
        flow(c.propagator(N(pi<N>() / c.nu))),
        d(1 + (flow.a + flow.c) + exp(N(-2 * c.h * pi<N>() / c.nu))),
        alpha((1 + R) * flow.b / d),
        gamma(((1 + R) * (1 + flow.a) / d - R) / c.nu),
        square(alpha * alpha + gamma * gamma) {}

  N R, g;
  motion::ArcConstants<N, Effects{E.damping, Forcing::regular}> c;
  motion::Propagator<N> flow;
  N d, alpha, gamma, square;
};

/// The speed before the impact, the phase of that on the upper stop, and the trace of half a period's map.
struct ClosedForm {
  double phase, speed, trace;
};
std::vector<ClosedForm> closed_forms(const Scene& scene) {
  using N = FiftyDigits;
  return with_arcs(scene, [&]<Effects E>() -> std::vector<ClosedForm> {
    const HalfPeriod<E> half(scene);
    const auto& [R, g, c, flow, d, alpha, gamma, square] = half;
    const N amplitude = c.response.amplitude;
    const N disc = alpha * alpha * g * g - square * (g * g - amplitude * amplitude);
    std::vector<ClosedForm> found;
    if (disc < 0) return found;
    for (const int sign : {-1, 1}) {
      const N u = (alpha * g + sign * sqrt(disc)) / square;
      if (u <= 0) continue;
      // (1 + flow) r = flow (-g, R u) - (g, u), the response r at the impact on the lower stop
      const N p = flow.a * -g + flow.b * R * u - g, q = flow.b * g + flow.c * R * u - u;
      const N x = ((1 + flow.c) * p - flow.b * q) / d, v = (flow.b * p + (1 + flow.a) * q) / d;
      // x = P sin + Q cos, v/nu = P cos - Q sin
      const N P = c.response.in_phase, Q = c.response.quadrature, size = amplitude * amplitude;
      const N sine = (P * x - Q * v / c.nu) / size, cosine = (Q * x + P * v / c.nu) / size;
      const N phase = atan2(sine, cosine) + pi<N>();  // of the upper stop
      const N force = c.f * sin(phase), before = force - g - 2 * c.h * u, after = force - g + 2 * c.h * R * u;
      const N corner = (R * before + after) / u;  // S = [[-R, 0], [corner, -R]]; the map is -flow S
      const N trace = -(flow.a * -R + flow.b * corner + flow.c * -R);
      found.push_back({static_cast<double>(phase), static_cast<double>(u), static_cast<double>(trace)});
    }
    return found;
  });
}

TEST(OrbitEquations, have_the_closed_form_of_one_impact_on_each_stop_as_solution) {
  std::mt19937 random(23);
  std::size_t solutions = 0;
  for (int i = 0; i < 1000; ++i) {
    const Scene scene = random_scene(random);
    for (const ClosedForm& known : closed_forms(scene)) {
      if (known.speed < 1e-3) continue;  // nearly a graze: ill-conditioned
      const Orbit shape{{{Side::upper, known.phase + 1e-6, known.speed * (1 + 1e-6)}}, 1, true};
      const OrbitEquations equations(scene, shape, {}, known.speed);
      const auto at = solution(equations, equations.unknowns_of(scene, shape), 1e-12);
      ASSERT_TRUE(at) << i;
      const Orbit orbit = equations.orbit_at(*at);
      const ImpactMap map = impact_map(scene, orbit);
      // the closer to a fold, the worse conditioned: the distance of a multiplier from 1
      const double condition = 1 + (1 + std::abs(map.trace())) / std::abs(1 + map.determinant - map.trace());
      EXPECT_NEAR(orbit.events[0].before, known.speed, 1e-13 * condition * std::max(1.0, known.speed)) << i;
      EXPECT_NEAR(std::remainder(orbit.events[0].phase - known.phase, 2 * M_PI), 0.0, 1e-12 * condition) << i;
      EXPECT_NEAR(map.trace(), known.trace, 1e-11 * condition * (1 + std::abs(known.trace)) / known.speed) << i;
      ++solutions;
    }
  }
  EXPECT_GT(solutions, 400);
}

/// The force amplitude at which both motions of the closed form become one, and the speed of their impacts: the
/// discriminant vanishes. Nothing if that speed isn't positive.
struct Fold {
  double forcing, speed;
};
std::optional<Fold> fold_of(const Scene& scene) {
  using N = FiftyDigits;
  return with_arcs(scene, [&]<Effects E>() -> std::optional<Fold> {
    const HalfPeriod<E> half(scene);
    const auto& [R, g, c, flow, d, alpha, gamma, square] = half;
    const N amplitude = g * abs(gamma) / sqrt(square);
    if (alpha <= 0) return std::nullopt;
    return Fold{static_cast<double>(N(c.f * amplitude / c.response.amplitude)),
                static_cast<double>(N(alpha * g / square))};
  });
}

TEST(OrbitEquations, with_a_multiplier_of_one_have_the_fold_of_the_closed_form_as_solution) {
  std::mt19937 random(29);
  std::size_t solutions = 0;
  for (int i = 0; i < 1000; ++i) {
    Scene scene = random_scene(random);
    const std::optional<Fold> fold = fold_of(scene);
    if (!fold || fold->speed < 1e-2) continue;
    scene.oscillator.forcing = fold->forcing * (1 + 1e-6);  // where there are two motions
    for (const ClosedForm& near : closed_forms(scene)) {
      const Orbit shape{{{Side::upper, near.phase, near.speed}}, 1, true};
      const OrbitEquations equations(scene, shape, {{Parameter("f"), fold->forcing}}, fold->speed,
                                     {{Condition::Kind::multiplier, 1}});
      const auto at = solution(equations, equations.unknowns_of(scene, shape), 1e-12);
      ASSERT_TRUE(at) << i;
      const Scene there = equations.scene_at(*at);
      const Orbit orbit = equations.orbit_at(*at);
      const double condition = 1 + 1 / fold->speed;
      EXPECT_NEAR(there.oscillator.forcing / fold->forcing, 1.0, 1e-13 * condition) << i;
      EXPECT_NEAR(orbit.events[0].before / fold->speed, 1.0, 1e-10 * condition) << i;
      EXPECT_NEAR(impact_map(there, orbit).distance_to(1), 0.0, 1e-12 * condition) << i;
      ++solutions;
    }
  }
  EXPECT_GT(solutions, 400);
}

TEST(OrbitEquations, know_the_multipliers_of_an_unstable_motion) {
  const Scene scene = symmetric_scene(0.1, 1.0, 2.0, 0.7, 0.5);
  const Orbit guess{{{Side::upper, 4.4663, 0.205}}, 1, true};
  const OrbitEquations equations(scene, guess, {}, 1.0);
  const auto at = solution(equations, equations.unknowns_of(scene, guess), 1e-13);
  ASSERT_TRUE(at);
  EXPECT_NEAR(equations.orbit_at(*at).events[0].before, 0.205083731882872, 1e-14);
  const ImpactMap map = impact_map(scene, equations.orbit_at(*at));
  EXPECT_NEAR(map.trace() / 2 + std::sqrt(map.trace() * map.trace() / 4 - map.determinant), 10.4402938, 5e-8);
}

TEST(OrbitEquations, of_a_multiplier_have_the_derivatives_of_their_differences) {
  const Scene scene = symmetric_scene(0.1, 1.0, 2.0, 0.7, 0.5);
  const Orbit orbit{{{Side::lower, 0.9, -0.8}, {Side::upper, 4.2, 0.9}}, 2, false};
  const OrbitEquations equations(scene, orbit, {{Parameter("nu"), 0.5}, {Parameter("R"), 0.3}}, 0.7,
                                 {{Condition::Kind::multiplier, -1}});
  const Vector z = equations.unknowns_of(scene, orbit);
  const auto here = equations.at(z);
  ASSERT_TRUE(here);
  for (std::size_t k = 0; k < z.size(); ++k) {
    Vector axis(z.size(), 0.0);
    axis[k] = 1e-6;  // truncation 1e-12, rounding 1e-10
    const auto ahead = equations.at(sum(z, 1.0, axis)), behind = equations.at(sum(z, -1.0, axis));
    for (std::size_t i = 0; i < equations.equations(); ++i)
      EXPECT_NEAR(here->slope(i, k), (ahead->residual[i] - behind->residual[i]) / 2e-6, 1e-8) << i << ' ' << k;
  }
}

TEST(Violation, tells_a_flight_through_a_stop_and_an_impact_that_pulls) {
  const Scene scene = symmetric_scene(0.1, 1.0, 2.0, 0.7, 0.5);
  const Orbit guess{{{Side::upper, 1.98, 0.93}}, 1, true};
  const OrbitEquations equations(scene, guess, {}, 1.0);
  const auto at = solution(equations, equations.unknowns_of(scene, guess), 1e-13);
  ASSERT_TRUE(at);
  const Orbit orbit = equations.orbit_at(*at);
  EXPECT_FALSE(violation(scene, orbit));
  Orbit pulling = orbit;
  pulling.events[0].before = -0.1;
  ASSERT_TRUE(violation(scene, pulling));
  EXPECT_EQ(violation(scene, pulling)->kind, Violation::Kind::pulls);
  const auto quiet = violation(scene, {{}, 1, true});  // the response has an amplitude of 0.33
  EXPECT_FALSE(quiet);
  const auto through = violation(symmetric_scene(0.1, 1.0, 2.0, 0.7, 0.3), {{}, 1, true});
  ASSERT_TRUE(through);
  EXPECT_EQ(through->kind, Violation::Kind::passes_through);
}

TEST(LinearSystem, is_solved_with_pivots) {
  Matrix matrix(3, 3);
  matrix.elements = {0, 2, 1, 1e-9, 1e-9, 0, 3, 0, 1};
  const auto x = solve(matrix, {7, 3e-9, 6});
  ASSERT_TRUE(x);
  EXPECT_NEAR((*x)[0], 1, 1e-14);
  EXPECT_NEAR((*x)[1], 2, 1e-14);
  EXPECT_NEAR((*x)[2], 3, 1e-14);
  matrix.elements = {1, 2, 3, 2, 4, 6, 0, 0, 1};
  EXPECT_FALSE(solve(matrix, {1, 2, 3}));
}

}  // namespace
}  // namespace clatter::branches::equations_test
