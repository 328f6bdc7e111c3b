// The simulator of `carry.hpp` against closed forms of the motion of a loose mass in a housing.

#include "hard/carry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace clatter::hard::carry_test {
namespace {

using Kind = CarryEvent::Kind;
using Real = CarryEvent::Real;

constexpr Real pi = std::numbers::pi_v<Real>;

std::vector<CarryEvent> those(const CarryRun& run, Kind kind, int side) {
  std::vector<CarryEvent> found;
  std::copy_if(run.events.begin(), run.events.end(), std::back_inserter(found),
               [&](const CarryEvent& event) { return event.kind == kind && event.side == side; });
  return found;
}

void expect_near(Real value, Real expected, Real tolerance = 1e-16L) {
  EXPECT_LE(std::abs(value - expected), tolerance * (1 + std::abs(expected)))
      << static_cast<double>(value) << " for " << static_cast<double>(expected);
}

/// The energy that is there is what the forces brought, less what damper and impacts took.
void expect_balance(const CarryRun& run, Real tolerance = 1e-16L) {
  const Real speed = run.fastest + run.fastest_main, size = speed * speed + std::abs(run.work) + run.damped;
  EXPECT_LE(std::abs(run.work - run.damped - run.struck - run.stored), tolerance * size);
}

/// A main mass without spring, damper and force, so that momentum is all there is.
CarryScene free_pair(double eps, double R) {
  return {.stiffness = 0, .loose_mass = eps, .lower = -0.5, .upper = 0.75, .restitution = R, .v = 0.25, .w = 1};
}

TEST(Carry, of_free_masses_slows_by_R_from_wall_to_wall_about_the_common_velocity) {
  for (const double R : {0.5, 0.9, 1.0}) {
    const Real eps = 0.3, gap = 1.25, common = 0.25L + eps / (1 + eps);
    const CarryRun run = carry(free_pair(0.3, R), 20);
    ASSERT_GE(run.events.size(), 4u);
    Real time = 0.75L, w = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      const CarryEvent& event = run.events[i];
      EXPECT_EQ(event.kind, Kind::impact);
      EXPECT_EQ(event.side, i % 2 == 0 ? 1 : -1);
      expect_near(event.time, time, 1e-15L), expect_near(event.w, w),
          expect_near(event.before + eps / (1 + eps) * w, common);
      w *= -R, time += gap / std::abs(w);
    }
    expect_near(run.v + run.w * eps / (1 + eps), common), expect_near(run.x + run.z * eps / (1 + eps), 20 * common);
    expect_balance(run);
  }
}

/// Thrown from the upper wall by R = 1/2 and pulled back by the loose load, it needs 2 w/g from impact to impact.
TEST(Carry, accumulates_on_a_wall_and_is_carried_from_then_on) {
  CarryScene scene = free_pair(0.5, 0.5);
  scene.lower = -std::numeric_limits<double>::infinity(), scene.v = 0, scene.w = 0, scene.loose_load = 2;
  const Real eps = 0.5, hit = std::sqrt(0.75L), w = 2 * hit;  // from a distance of 3/4
  const CarryRun run = carry(scene, 5);
  const auto impacts = those(run, Kind::impact, 1), carried = those(run, Kind::carried, 1);
  ASSERT_GT(impacts.size(), 40u);
  ASSERT_EQ(carried.size(), 1u);
  for (std::size_t i = 0; i < 40; ++i) expect_near(impacts[i].w / std::pow(Real(0.5), Real(i)), w);
  const Real end = hit + w / 2 / (1 - 0.5L);  // w + w/2 + ... at 2 w'/g after the first
  expect_near(carried[0].time, end, 1e-15L);
  EXPECT_EQ(carried[0].until, 5);
  expect_near(run.v, eps / (1 + eps) * 2 * 5, 1e-15L);
  EXPECT_EQ(run.z, 0.75L);
  EXPECT_EQ(run.w, 0);
  expect_balance(run);
}

/// On the lower wall of a main mass of stiffness k = (1 + eps): carried x = cos tau from 1. The wall lets go where
/// x'' = 0, and the loose mass goes on at the speed of that instant.
TEST(Carry, lets_go_where_the_wall_would_have_to_pull) {
  CarryScene scene{.stiffness = 1.25, .loose_mass = 0.25, .lower = -2, .upper = 3, .restitution = 0.5};
  scene.x = -1, scene.z = -2;
  const CarryRun run = carry(scene, 2);
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].side, -1);
  expect_near(run.events[0].until, pi / 2);
  const Real rate = std::sqrt(1.25L), flight = 2 - pi / 2;
  expect_near(run.x, std::sin(rate * flight) / rate), expect_near(run.v, std::cos(rate * flight));
  expect_near(run.x + run.z, -2 + flight), expect_near(run.v + run.w, 1);
  expect_near(run.of_x.least, -1), expect_near(run.of_y.least, -3), expect_near(run.of_z.least, -2);
  expect_balance(run);
}

TEST(Carry, flies_at_once_from_a_wall_that_would_have_to_pull) {
  CarryScene scene{.stiffness = 1, .loose_mass = 0.25, .lower = -2, .upper = 3, .restitution = 0.5, .x = 1, .z = -2};
  const CarryRun run = carry(scene, 1);
  EXPECT_TRUE(run.events.empty());
  expect_near(run.x, std::cos(1.0L)), expect_near(run.x + run.z, -1);
}

TEST(Carry, begins_with_an_impact_if_it_moves_into_its_wall) {
  CarryScene scene = free_pair(0.3, 0.5);
  scene.z = scene.upper;
  const CarryRun run = carry(scene, 0.125);
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].time, 0);
  expect_near(run.w, -0.5L), expect_near(run.v, 0.25L + 0.3L * 1.5L / 1.3L, 1e-16L);
}

/// A scene of symmetric motion with two impacts a period, started at an impact on the upper wall.
struct Symmetric {
  Real x, before, after, w;  ///< of the main mass at the impact, and z' before it
  Real phase;                ///< of the force then
};

/// In terms of c, the speed of the loose mass: x = c pi/(2 nu) - s, w = 2 c (1 + eps)/(1 + R), x' = c - w before and
/// 2 eps c more after. Half a period turns (x, x') round, which gives the free part of x in terms of c. The rest is
/// the response to the force, whose amplitude is known.
Symmetric symmetric(const CarryScene& scene) {
  const Real h = scene.damping, nu = scene.frequency, f = scene.forcing, eps = scene.loose_mass, s = scene.upper;
  const Real half = pi / nu, rate = std::sqrt(1 - h * h), decay = std::exp(-h * half);
  const Real cosine = std::cos(rate * half) * decay, sine = std::sin(rate * half) * decay / rate;
  const Real m11 = 1 + cosine + h * sine, m12 = sine, m21 = -sine, m22 = 1 + cosine - h * sine;
  const Real determinant = m11 * m22 - m12 * m21;
  const Real free_x = -2 * eps * m12 / determinant, free_v = 2 * eps * m11 / determinant;
  const Real w = 2 * (1 + eps) / (1 + Real(scene.restitution)), after = 1 - w + 2 * eps;
  const Real p = half / 2 - free_x, q = (after - free_v) / nu;  // response: p c - s, and its velocity over nu: q c
  const Real amplitude = f / std::hypot(1 - nu * nu, 2 * h * nu);
  const Real a = p * p + q * q, b = p * s, root = std::sqrt(b * b - a * (s * s - amplitude * amplitude));
  const Real c = (b + root) / a, response = p * c - s, slope = q * c;
  // response = (f sin(theta - delta))/|..|: the phase of the response, and delta behind that of the force
  const Real phase = std::atan2(response, slope) + std::atan2(2 * h * nu, 1 - nu * nu);
  return {c * half / 2 - s, c - w * c, c - w * c + 2 * eps * c, w * c, phase};
}

/// Numbers that were computed before the simulator was written.
TEST(Carry, keeps_symmetric_motion_with_two_impacts_a_period) {
  CarryScene scene{
      .damping = 0.005, .forcing = 0.01, .loose_mass = 0.02, .lower = -0.4, .upper = 0.4, .restitution = 0.8};
  const Symmetric known = symmetric(scene);
  const CarryRun run = carry(scene, 1200 * 2 * pi, 10000);
  ASSERT_GT(run.events.size(), 2000u);
  ASSERT_TRUE(run.completed);
  const CarryEvent& last = run.events.back();
  expect_near(known.w, 0.418893828273064L, 1e-15L), expect_near(known.x, 0.180585488325042L, 1e-15L);
  expect_near(known.before, -0.0492816268556546L, 1e-15L), expect_near(known.after, -0.034497138798958L, 1e-15L);
  expect_near(last.side * last.w, known.w, 1e-14L), expect_near(last.side * last.x, known.x, 1e-14L);
  expect_near(last.side * last.before, known.before, 1e-14L), expect_near(last.side * last.after, known.after, 1e-14L);
  expect_balance(run, 1e-15L);
}

TEST(Carry, leaves_an_unstable_symmetric_motion_in_a_spiral) {
  CarryScene scene{.damping = 0.02,
                   .forcing = 0.3,
                   .frequency = 1.3,
                   .loose_mass = 0.05,
                   .lower = -1.9,
                   .upper = 1.9,
                   .restitution = 0.6};
  const Symmetric known = symmetric(scene);
  scene.phase = static_cast<double>(known.phase), scene.x = static_cast<double>(known.x);
  scene.v = static_cast<double>(known.before), scene.z = scene.upper, scene.w = static_cast<double>(known.w);
  expect_near(known.w, 2.123117L, 1e-6L);
  const CarryRun run = carry(scene, 20.25 * 2 * pi / 1.3L);
  ASSERT_EQ(run.events.size(), 41u);
  for (const CarryEvent& event : run.events) {
    expect_near(event.side * event.w, known.w, 1e-13L);
    expect_near(event.side * event.x, known.x, 1e-13L);
  }
}

/// At the equilibrium of both nothing happens; shaken with its base, the main mass moves as b sin(nu tau) does under a
/// spring that is as good as rigid.
TEST(Carry, is_shaken_by_its_base) {
  CarryScene scene{.damping = 0.1,
                   .stiffness = 2,
                   .frequency = 0.8,
                   .base_amplitude = 0.3,
                   .loose_mass = 1e-3,
                   .lower = -100,
                   .upper = 100};
  const Real k = 2, c = 2 * Real(scene.damping), nu = scene.frequency, b = scene.base_amplitude;
  const Real amplitude = b * std::hypot(k, c * nu) / std::hypot(k - nu * nu, c * nu);
  const CarryRun run = carry(scene, 500);
  EXPECT_TRUE(run.events.empty());
  const Real rest = std::exp(-50.0L) * 2;
  const Real lag = std::atan2(c * nu, k - nu * nu) - std::atan2(c * nu, k);
  expect_near(run.x, amplitude * std::sin(nu * 500 - lag), 1e-15L + rest);
  expect_balance(run);
}

TEST(Carry, keeps_the_energy_of_elastic_impacts) {
  CarryScene scene{.loose_mass = 0.4, .lower = -0.3, .upper = 0.5, .x = 1, .v = 0.5, .w = 0.7};
  const CarryRun run = carry(scene, 500);
  EXPECT_GT(run.events.size(), 300u);
  EXPECT_EQ(run.struck, 0);
  EXPECT_LE(std::abs(run.stored), 1e-15L);
}

}  // namespace
}  // namespace clatter::hard::carry_test
