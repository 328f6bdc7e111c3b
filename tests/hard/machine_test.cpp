// The simulator of `machine.hpp` against closed forms of motion with dry friction, and against numbers that were
// published or computed before it was written.

#include "hard/machine.hpp"

#include <array>
#include <utility>

#include "hard/machine_checks.hpp"
#include "hard/machine_series.hpp"

namespace clatter::hard::machine_test {
namespace {

using namespace machine_checks;

// The first zero.

/// The product of (u - root), from its roots.
machine::Series from_roots(const std::vector<double>& roots) {
  machine::Series p{1};
  for (const double root : roots)
    for (std::size_t k = machine::terms; k-- > 0;) p[k] = (k > 0 ? p[k - 1] : 0) - root * p[k];
  return p;
}

TEST(FirstFall, finds_the_first_of_two_close_zeros_and_no_zero_that_is_none) {
  for (const double apart : {1e-1, 1e-4, 1e-8}) {
    const auto found = machine::first_fall(from_roots({0.3, 0.3 + apart}));
    ASSERT_TRUE(found) << apart;
    expect_near(static_cast<Real>(*found), Real(0.3), 1e-18L);
    machine::Series lifted = from_roots({0.3, 0.3});
    lifted[0] += apart * apart;
    EXPECT_FALSE(machine::first_fall(lifted)) << apart;
  }
  EXPECT_FALSE(machine::first_fall(from_roots({1.1, 1.2})));
  expect_near(static_cast<Real>(machine::first_fall(from_roots({0.9, 0.2, 0.7, 0.4})).value()), Real(0.2), 1e-18L);
}

TEST(FirstFall, begins_at_an_exact_zero_by_its_direction) {
  EXPECT_EQ(machine::first_fall({0, 0, 1, -2}).value(), machine::Quad(0.5));
  EXPECT_EQ(machine::first_fall({0, 0, 0, -1, 5}).value(), 0);
  EXPECT_FALSE(machine::first_fall({0, 1, -0.5}));
}

// Dry friction.

TEST(Machine, loses_four_times_the_friction_a_turn_and_stops) {
  const MachineRun run = run_of({.friction = 1, .static_friction = 1, .x = 5.3}, 20);
  const auto reversals = those(run, Told::reversal), sticks = those(run, Told::stick);
  ASSERT_EQ(reversals.size(), 2u);
  ASSERT_EQ(sticks.size(), 1u);
  expect_near(reversals[0].time, pi), expect_near(reversals[1].time, 2 * pi), expect_near(sticks[0].time, 3 * pi);
  const Real start = 5.3;
  expect_near(reversals[0].place, 2 - start), expect_near(reversals[1].place, start - 4);
  expect_near(sticks[0].place, 6 - start);
  EXPECT_EQ(sticks[0].until, 20);
  expect_near(reversals[0].pull, start - 2 + 1);
  expect_near(run.rubbed, (start * start - (6 - start) * (6 - start)) / 2);
  expect_near(run.of_x.least, 2 - start), expect_near(run.of_x.greatest, start);
  EXPECT_TRUE(run.finished);
  expect_loss(run);
}

/// Den Hartog 1931: forced undamped motion without stops and without a stick has the amplitude (V^2 - (mu U)^2)^(1/2).
/// At its peak the force has the phase whose cosine is mu U/V.
TEST(Machine, keeps_the_amplitude_of_den_hartog) {
  struct Case {
    double nu, mu;
    Real amplitude;
  };
  for (const auto& [nu, mu, amplitude] : {Case{0.8, 0.3, 2.62610487572348L}, Case{1.3, 0.2, 1.39134462914783L}}) {
    const Real V = 1 / (1 - Real(nu) * nu), U = std::sin(pi / nu) / (nu * (1 + std::cos(pi / nu)));
    expect_near(std::sqrt(V * V - mu * mu * U * U), amplitude, 1e-14L);
    const MachineRun run = run_of({.forcing = 1,
                                   .frequency = nu,
                                   .phase = static_cast<double>(std::atan2(amplitude / V, mu * U / V)),
                                   .friction = mu,
                                   .static_friction = mu,
                                   .x = static_cast<double>(amplitude)},
                                  40.5L * pi / nu);
    const auto reversals = those(run, Told::reversal);
    ASSERT_EQ(reversals.size(), 40u);
    ASSERT_EQ(told_events(run).size(), 40u);
    for (std::size_t i = 0; i < 40; ++i) {
      expect_near(reversals[i].time, Real(i + 1) * pi / nu, 1e-12L);
      expect_near(reversals[i].place, i % 2 == 0 ? -amplitude : amplitude, 1e-12L);
    }
  }
}

/// A mass on a floor, without a spring.
MachineScene on_floor(double weight, double R, double friction, double static_friction) {
  return {.stiffness = 0,
          .load = -weight,
          .friction = friction,
          .static_friction = static_friction,
          .lower = 0,
          .restitution_lower = R,
          .v = 1};
}

TEST(Machine, chatters_at_the_ratio_that_friction_leaves) {
  for (const double R : {0.5, 0.9, 1.0}) {
    const Real a = 2, mu = 0.5, rho = R * std::sqrt((a - mu) / (a + mu));
    const MachineRun run = run_of(on_floor(2, R, 0.5, 0.75), 20);
    const auto impacts = those(run, Told::impact, Side::lower), rests = those(run, Told::rest, Side::lower);
    ASSERT_GT(impacts.size(), 20u);
    ASSERT_EQ(rests.size(), 1u);
    for (std::size_t i = 0; i < impacts.size(); ++i)
      expect_near(-R * impacts[i].velocity / std::pow(rho, Real(i + 1)), 1, 1e-14L);
    expect_near(rests[0].time, (1 / (a + mu) + 1 / std::sqrt(a * a - mu * mu)) / (1 - rho));
    EXPECT_EQ(run.x, 0);
    expect_near(run.of_x.greatest, 1 / (2 * (a + mu)));
  }
}

TEST(Machine, stays_off_the_floor_if_friction_holds_it_at_its_peak) {
  const MachineRun run = run_of(on_floor(2, 0.9, 0.5, 2.5), 20);
  expect_near(only(run, Told::stick).time, 0.4L), expect_near(run.x, 0.2L);
}

TEST(Machine, is_released_at_the_phase_at_which_the_force_passes_the_static_level) {
  MachineScene scene{.forcing = 1, .frequency = 0.7, .friction = 0.3, .static_friction = 0.6, .x = 0.1};
  expect_near(only(run_of(scene, 1.5), Told::stick).until, std::asin(Real(0.6) + Real(0.1)) / Real(0.7));
  scene.phase = 2;  // sin 2 is beyond the level: it goes at once, up; from 3 on it waits for the other side
  EXPECT_EQ(run_of(scene, 0.5).events.size(), 0u);
  EXPECT_GT(run_of(scene, 0.1).x, 0.1L);
  scene.phase = 3;
  const MachineRun down = run_of(scene, 3);
  expect_near(only(down, Told::stick).until, (std::asin(Real(0.6) - Real(0.1)) + pi - 3) / Real(0.7));
  EXPECT_LT(down.v, 0);
}

TEST(Machine, rests_on_a_rigid_stop_until_the_pull_away_passes_the_static_level) {
  MachineScene scene = on_floor(0.2, 0.5, 0.1, 0.3);
  scene.forcing = 1, scene.v = 0, scene.phase = -1;
  const MachineRun run = run_of(scene, 1.8);
  expect_near(only(run, Told::rest, Side::lower).until, std::asin(Real(0.2) + Real(0.3)) + 1);
  EXPECT_GT(run.v, 0);
}

/// Pressed by a speed into a soft stop without a damper: to and from the depth d at which
/// v^2 = kappa d^2 + 2 mu d (k = 0), then d' with kappa d'^2 = kappa d^2 - 2 mu d on leaving it.
TEST(Machine, loses_in_a_soft_stop_the_work_of_friction) {
  const MachineRun run =
      run_of({.stiffness = 0, .friction = 0.5, .static_friction = 0.5, .upper = 0, .kappa_upper = 100, .v = 1}, 0.4);
  const Real kappa = 100, mu = 0.5, depth = (std::sqrt(mu * mu + kappa) - mu) / kappa;
  const auto events = told_events(run);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].kind, Told::touch);
  EXPECT_EQ(events[1].kind, Told::reversal);
  EXPECT_EQ(events[2].kind, Told::separation);
  expect_near(events[1].place, depth), expect_near(run.of_x.greatest, depth);
  expect_near(events[1].pull, -kappa * depth - mu);
  expect_near(events[2].velocity, -std::sqrt(1 - 4 * mu * depth));
}

TEST(Machine, sticks_inside_a_soft_stop) {
  MachineScene scene{
      .stiffness = 0, .friction = 0.3, .static_friction = 0.5, .upper = 0, .kappa_upper = 100, .x = 0.004};
  EXPECT_EQ(only(run_of(scene, 10), Told::stick).until, 10);
  scene.x = 0.006;
  EXPECT_LT(run_of(scene, 0.1).v, 0);
}

/// A soft stop without a spring to speak of beside its damper lets go of the mass beyond its position, and catches up.
TEST(Machine, outruns_a_damped_soft_stop_where_its_force_is_gone) {
  const MachineScene scene{
      .friction = 0.1, .static_friction = 0.1, .upper = 0, .kappa_upper = 4, .zeta_upper = 0.9, .x = -0.5, .v = 1};
  const auto separations = those(run_of(scene, 3), Told::separation, Side::upper);
  ASSERT_FALSE(separations.empty());
  EXPECT_LT(separations[0].velocity, 0);
  // at the separation kappa depth + 2 zeta kappa^(1/2) v = 0
  const MachineRun before = run_of(scene, separations[0].time);
  expect_near(before.x, -2 * Real(0.9) * 2 * separations[0].velocity / 4),
      expect_near(before.v, separations[0].velocity);
}

/// Stops at +-0.5 with a stick a period; the mirror image from the other start.
MachineScene with_a_stick(double start) {
  return {.damping = 0.05,
          .forcing = 1,
          .frequency = 1.3,
          .friction = 0.2,
          .static_friction = 0.2,
          .lower = -0.5,
          .upper = 0.5,
          .restitution_lower = 0.7,
          .restitution_upper = 0.7,
          .x = start};
}

TEST(Machine, settles_on_the_motion_with_a_stick_and_its_mirror_image) {
  for (const auto& [start, sign] : {std::pair{0.0, 1}, {0.1, -1}}) {
    const MachineRun run = run_of(with_a_stick(start), 200 * pi / 1.3L);
    const Side above = sign > 0 ? Side::upper : Side::lower;
    expect_near(those(run, Told::impact, above).back().velocity, sign * 0.940532086164330L, 1e-14L);
    expect_near(those(run, Told::impact, opposite(above)).back().velocity, -sign * 0.718708034646616L, 1e-14L);
    const auto sticks = those(run, Told::stick);
    const ToldEvent& stick = sticks[sticks.size() - 2];  // the last one may be cut by the end
    expect_near(stick.until - stick.time, 0.315340026143191L, 1e-14L);
    expect_near(stick.place, -sign * 0.327636229491487L, 1e-14L);
  }
}

/// The place of the stick after one that begins at a place.
Real next_place(Real place) {
  const auto sticks = those(run_of(with_a_stick(0), 200 * pi / 1.3L), Told::stick);
  MachineScene scene = with_a_stick(static_cast<double>(place));
  scene.phase = static_cast<double>(std::fmod(1.3L * sticks[sticks.size() - 2].time, 2 * pi)) + 0.01;
  return those(run_of(scene, 9), Told::stick).at(1).place;
}

TEST(Machine, maps_the_place_of_a_stick_with_the_known_derivative) {
  const double place = -0.327636229491487, step = 1e-5;
  const Real derivative = (next_place(place + step) - next_place(place - step)) / (2 * Real(step));
  expect_near(derivative, 0.267959696315445L, 1e-9L);  // the step's square, and the roundings of both places over it
}

/// The determinant of the flow over a time, by differences.
Real determinant(const MachineScene& scene, Real time) {
  const double step = 1e-5;
  const auto end = [&](double dx, double dv) {
    MachineScene moved = scene;
    moved.x += dx, moved.v += dv;
    const MachineRun run = run_of(moved, time);
    return std::array{run.x, run.v};
  };
  const auto right = end(step, 0), left = end(-step, 0), faster = end(0, step), slower = end(0, -step);
  return ((right[0] - left[0]) * (faster[1] - slower[1]) - (right[1] - left[1]) * (faster[0] - slower[0])) /
         (4 * Real(step) * step);
}

/// Friction jumps by 2 mu at a reversal.
TEST(Machine, reverses_with_the_quotient_of_the_accelerations_in_the_determinant) {
  const MachineScene scene{
      .damping = 0.05, .forcing = 1, .frequency = 0.8, .friction = 0.3, .static_friction = 0.3, .x = -0.5, .v = -1.5};
  const Real period = 2 * pi / 0.8L, decay = std::exp(-2 * Real(0.05) * period);
  const auto quotient = [](const ToldEvent& e) { return (e.pull + (e.pull > 0 ? -0.6L : 0.6L)) / e.pull; };
  const MachineRun run = run_of(scene, period);
  const auto reversals = those(run, Told::reversal);
  ASSERT_FALSE(reversals.empty());
  ASSERT_EQ(reversals.size(), told_events(run).size());
  Real expected = decay;
  for (const ToldEvent& reversal : reversals) expected *= quotient(reversal);
  expect_near(determinant(scene, period) / expected, 1, 1e-7L);  // the square of the step
  // settled, the product of both multipliers is known
  const auto last = those(run_of(scene, 100 * period), Told::reversal);
  expect_near(decay * quotient(last[last.size() - 2]) * quotient(last.back()), 0.20139584L, 1e-8L);
}

}  // namespace
}  // namespace clatter::hard::machine_test
