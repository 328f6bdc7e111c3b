// The simulator of `machine.hpp` against closed forms of the motion of a loose mass in a housing.

#include "hard/machine.hpp"
#include "hard/machine_checks.hpp"

namespace clatter::hard::machine_loose_test {
namespace {

using namespace machine_checks;

/// A main mass without spring, damper and force, so that momentum is all there is.
MachineScene free_pair(double eps, double R) {
  return {.stiffness = 0,
          .loose_mass = eps,
          .wall_lower = -0.5,
          .wall_upper = 0.75,
          .wall_R_lower = R,
          .wall_R_upper = R,
          .v = 0.25,
          .w = 1};
}

TEST(Machine, of_free_masses_slows_by_R_from_wall_to_wall_about_the_common_velocity) {
  for (const double R : {0.5, 0.9, 1.0}) {
    const Real eps = 0.3, gap = 1.25, common = 0.25L + eps / (1 + eps);
    const MachineRun run = run_of(free_pair(0.3, R), 20);
    ASSERT_GE(run.events.size(), 4u);
    Real time = 0.75L, w = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      const MachineEvent& event = run.events[i];
      EXPECT_EQ(event.kind, MachineEvent::Kind::wall_impact);
      EXPECT_EQ(event.side, i % 2 == 0 ? 1 : -1);
      expect_near(event.time, time), expect_near(event.before, w),
          expect_near(event.main_before + eps / (1 + eps) * w, common);
      w *= -R, time += gap / std::abs(w);
    }
    expect_near(run.v + run.w * eps / (1 + eps), common), expect_near(run.x + run.z * eps / (1 + eps), 20 * common);
    expect_loss(run);
  }
}

/// Thrown from the upper wall by R = 1/2 and pulled back by the loose load, it needs 2 w/g from impact to impact.
TEST(Machine, accumulates_on_a_wall_and_is_carried_from_then_on) {
  MachineScene scene = free_pair(0.5, 0.5);
  scene.wall_lower = -no_stop, scene.v = 0, scene.w = 0, scene.loose_load = 2;
  const Real eps = 0.5, hit = std::sqrt(0.75L), w = 2 * hit;  // from a distance of 3/4
  const MachineRun run = run_of(scene, 5);
  const auto impacts = those(run, Told::impact, Side::upper), carried = those(run, Told::rest, Side::upper);
  ASSERT_GT(impacts.size(), 40u);
  ASSERT_EQ(carried.size(), 1u);
  for (std::size_t i = 0; i < impacts.size(); ++i) expect_near(impacts[i].velocity / std::pow(0.5L, Real(i)), w);
  expect_near(carried[0].time, hit + w / 2 / (1 - 0.5L));  // w + w/2 + ... at 2 w'/g after the first
  EXPECT_EQ(carried[0].until, 5);
  expect_near(carried[0].pull, 2);
  expect_near(run.v, eps / (1 + eps) * 2 * 5);
  EXPECT_EQ(run.z, 0.75L);
  EXPECT_EQ(run.w, 0);
}

/// On the lower wall of a main mass of stiffness k = (1 + eps): carried x = cos tau from 1. The wall lets go where
/// x'' = 0, and the loose mass goes on at the speed of that instant.
TEST(Machine, lets_go_where_the_wall_would_have_to_pull) {
  const MachineScene scene{.stiffness = 1.25, .loose_mass = 0.25, .wall_lower = -2, .wall_upper = 3, .x = -1, .z = -2};
  const MachineRun run = run_of(scene, 2);
  expect_near(only(run, Told::rest, Side::lower).until, pi / 2);
  const Real rate = std::sqrt(1.25L), flight = 2 - pi / 2;
  expect_near(run.x, std::sin(rate * flight) / rate), expect_near(run.v, std::cos(rate * flight));
  expect_near(run.x + run.z, -2 + flight), expect_near(run.v + run.w, 1);
  expect_near(run.of_x.least, -1), expect_near(run.of_y.least, -3), expect_near(run.of_z.least, -2);
  expect_loss(run);
}

TEST(Machine, flies_at_once_from_a_wall_that_would_have_to_pull) {
  const MachineRun run = run_of({.loose_mass = 0.25, .wall_lower = -2, .wall_upper = 3, .x = 1, .z = -2}, 1);
  EXPECT_TRUE(run.events.empty());
  expect_near(run.x, std::cos(1.0L)), expect_near(run.x + run.z, -1);
}

TEST(Machine, begins_with_an_impact_if_it_moves_into_its_wall) {
  MachineScene scene = free_pair(0.3, 0.5);
  scene.z = scene.wall_upper;
  const MachineRun run = run_of(scene, 0.125);
  EXPECT_EQ(only(run, Told::impact, Side::upper).time, 0);
  expect_near(run.w, -0.5L), expect_near(run.v, 0.25L + 0.3L * 1.5L / 1.3L);
  EXPECT_EQ(run.struck, 0);
}

/// A scene of symmetric motion with two impacts a period, started at an impact on the upper wall.
struct Symmetric {
  Real x, before, after, w;  ///< of the main mass at the impact, and z' before it
  Real phase;                ///< of the force then
};

/// In terms of c, the speed of the loose mass: x = c pi/(2 nu) - s, w = 2 c (1 + eps)/(1 + R), x' = c - w before and
/// 2 eps c more after. Half a period turns (x, x') round, which gives the free part of x in terms of c. The rest is
/// the response to the force, whose amplitude is known.
Symmetric symmetric(const MachineScene& scene) {
  const Real h = scene.damping, nu = scene.frequency, f = scene.forcing, eps = scene.loose_mass, s = scene.wall_upper;
  const Real half = pi / nu, rate = std::sqrt(1 - h * h), decay = std::exp(-h * half);
  const Real cosine = std::cos(rate * half) * decay, sine = std::sin(rate * half) * decay / rate;
  const Real m11 = 1 + cosine + h * sine, m12 = sine, m21 = -sine, m22 = 1 + cosine - h * sine;
  const Real determinant = m11 * m22 - m12 * m21;
  const Real free_x = -2 * eps * m12 / determinant, free_v = 2 * eps * m11 / determinant;
  const Real w = 2 * (1 + eps) / (1 + Real(scene.wall_R_upper)), after = 1 - w + 2 * eps;
  const Real p = half / 2 - free_x, q = (after - free_v) / nu;  // response: p c - s, and its velocity over nu: q c
  const Real amplitude = f / std::hypot(1 - nu * nu, 2 * h * nu);
  const Real a = p * p + q * q, b = p * s, root = std::sqrt(b * b - a * (s * s - amplitude * amplitude));
  const Real c = (b + root) / a, response = p * c - s, slope = q * c;
  // response = (f sin(theta - delta))/|..|: the phase of the response, and delta behind that of the force
  const Real phase = std::atan2(response, slope) + std::atan2(2 * h * nu, 1 - nu * nu);
  return {c * half / 2 - s, c - w * c, c - w * c + 2 * eps * c, w * c, phase};
}

MachineScene damper(double h, double f, double nu, double eps, double s, double R) {
  return {.damping = h,
          .forcing = f,
          .frequency = nu,
          .loose_mass = eps,
          .wall_lower = -s,
          .wall_upper = s,
          .wall_R_lower = R,
          .wall_R_upper = R};
}
void expect_symmetric(const ToldEvent& event, const Symmetric& known, Real tolerance) {
  const int side = sign_of(event.side);
  expect_near(side * event.velocity, known.w, tolerance), expect_near(side * event.place, known.x, tolerance);
  expect_near(side * event.before, known.before, tolerance), expect_near(side * event.after, known.after, tolerance);
}

/// Numbers that were computed before the simulator was written.
TEST(Machine, keeps_symmetric_motion_with_two_impacts_a_period) {
  const MachineScene scene = damper(0.005, 0.01, 1, 0.02, 0.4, 0.8);
  const Symmetric known = symmetric(scene);
  const MachineRun run = run_of(scene, 1200 * 2 * pi);
  ASSERT_GT(run.events.size(), 2000u);
  ASSERT_TRUE(run.finished);
  expect_near(known.w, 0.418893828273064L), expect_near(known.x, 0.180585488325042L);
  expect_near(known.before, -0.0492816268556546L), expect_near(known.after, -0.034497138798958L);
  expect_symmetric(told_events(run).back(), known, 1e-14L);
}

TEST(Machine, leaves_an_unstable_symmetric_motion_in_a_spiral) {
  MachineScene scene = damper(0.02, 0.3, 1.3, 0.05, 1.9, 0.6);
  const Symmetric known = symmetric(scene);
  scene.phase = static_cast<double>(known.phase), scene.x = static_cast<double>(known.x);
  scene.v = static_cast<double>(known.before), scene.z = scene.wall_upper, scene.w = static_cast<double>(known.w);
  expect_near(known.w, 2.123117L, 1e-6L);
  const auto events = told_events(run_of(scene, 20.25L * 2 * pi / 1.3L));
  ASSERT_EQ(events.size(), 41u);
  for (const ToldEvent& event : events) expect_symmetric(event, known, 1e-13L);
}

TEST(Machine, keeps_the_energy_of_elastic_impacts_and_loses_to_all_others_what_it_had) {
  MachineScene scene{.loose_mass = 0.4, .wall_lower = -0.3, .wall_upper = 0.5, .x = 1, .v = 0.5, .w = 0.7};
  const MachineRun elastic = run_of(scene, 500);
  EXPECT_GT(elastic.events.size(), 300u);
  EXPECT_EQ(elastic.struck, 0);
  expect_near(elastic.stored, 0, 1e-17L);
  scene.wall_R_lower = scene.wall_R_upper = 0.9, scene.damping = 0.01, scene.friction = scene.static_friction = 0.01;
  scene.x = 0.5, scene.upper = 0.6, scene.restitution_upper = 0.8;
  const MachineRun run = run_of(scene, 50);
  for (const Real part : {run.damped, run.struck, run.rubbed}) EXPECT_GT(part, 0.01L);
  expect_loss(run);
}

}  // namespace
}  // namespace clatter::hard::machine_loose_test
