// What forces that jump or bend let go, hold, throw and press in the simulator of `machine.hpp`, against closed forms.

#include <cmath>

#include "hard/machine.hpp"
#include "hard/machine_checks.hpp"

namespace clatter::hard::machine_force_events_test {
namespace {

using namespace machine_checks;
using Kind = MachineEvent::Kind;

// Dry friction.

/// Each pulse sets a mass on a floor going, which friction stops before the next.
TEST(Machine, creeps_by_pulses_and_sticks_between_them) {
  const MachineScene scene{.stiffness = 0,
                           .forcing = 2,
                           .frequency = 0.5,
                           .shape = ForceShape::pulse,
                           .duty = 0.125,
                           .friction = 0.75,
                           .static_friction = 1};
  const Real period = 4 * pi, pulse = period / 8, way = (2 - 0.75L) * pulse * pulse / 2 * (2 / 0.75L);
  const auto sticks = those(run_of(scene, 3.5L * period), Told::stick);
  ASSERT_EQ(sticks.size(), 4u);
  for (std::size_t i = 0; i < sticks.size(); ++i) {
    expect_near(sticks[i].time, Real(i) * period + pulse * 2 / 0.75L);
    expect_near(sticks[i].until, std::min(Real(i + 1), 3.5L) * period);
    expect_near(sticks[i].place, Real(i + 1) * way);
  }
}

TEST(Machine, is_let_go_within_a_half_sine_after_a_piece_without_force) {
  MachineScene scene{.forcing = 1,
                     .frequency = 0.7,
                     .phase = 4,
                     .shape = ForceShape::half_sine,
                     .duty = 0.25,
                     .friction = 0.3,
                     .static_friction = 0.6};
  const ToldEvent stick = only(run_of(scene, 4), Told::stick);
  EXPECT_EQ(stick.time, 0);
  expect_near(stick.until, (2 * pi - 4 + std::asin(Real(0.6)) / 2) / Real(0.7));
  scene.static_friction = 1 + 0x1p-40;  // above the peak
  EXPECT_EQ(only(run_of(scene, 40), Told::stick).until, 40);
}

TEST(Machine, holds_against_a_corner_or_a_plateau_as_high_as_the_static_level) {
  MachineScene scene{.forcing = 0.75, .frequency = 0.7, .friction = 0.25, .static_friction = 0.75};
  for (scene.shape = ForceShape::triangle;; scene.shape = ForceShape::trapezoid) {
    scene.forcing = 0.75;
    EXPECT_EQ(only(run_of(scene, 40), Told::stick).until, 40);
    scene.forcing = 0.75 * (1 + 0x1p-40);
    const Real rise = scene.shape == ForceShape::triangle ? 0.5 : 0.25;
    expect_near(only(run_of(scene, 2.3), Told::stick).until,
                0.75L / Real(scene.forcing) * rise / 2 * 2 * pi / Real(0.7));
    if (scene.shape == ForceShape::trapezoid) break;
  }
}

// Stops.

/// A mass on a floor, pressed by 1.25 and lifted by 0.75 in turn.
TEST(Machine, rests_on_a_stop_until_the_force_jumps) {
  MachineScene scene{.forcing = 1,
                     .frequency = 0.9,
                     .phase = 3,
                     .load = -0.25,
                     .shape = ForceShape::square,
                     .duty = 0.375,
                     .lower = 0,
                     .restitution_lower = 0.5};
  const Real jump = (2 * pi - 3) / Real(0.9);
  const MachineRun run = run_of(scene, jump + 1);
  expect_near(only(run, Told::rest, Side::lower).until, jump);
  expect_near(run.x, 0.75L * (1 - std::cos(1.0L)));
  scene.friction = scene.static_friction = 0.75;  // as much as lifts it
  EXPECT_EQ(only(run_of(scene, 40), Told::rest, Side::lower).until, 40);
  scene.friction = 0.5;
  EXPECT_EQ(only(run_of(scene, 40), Told::rest, Side::lower).until, 40);
}

/// At the place at which the spring has no force nothing holds it in the pause, and nothing moves it.
TEST(Machine, stays_on_a_stop_in_the_pause_between_pulses_that_lift_it) {
  const MachineScene scene{.forcing = 1,
                           .frequency = 0.9,
                           .phase = 4,
                           .shape = ForceShape::pulse,
                           .duty = 0.5,
                           .lower = 0,
                           .restitution_lower = 0};
  const Real begin = (2 * pi - 4) / Real(0.9), half = pi / Real(0.9);
  const MachineRun run = run_of(scene, begin + half);  // x = 1 - cos tau, and comes down after the pulse
  expect_near(only(run, Told::rest, Side::lower).until, begin);
  expect_near(run.x, 1 - std::cos(half)), expect_near(run.v, std::sin(half));
  const Real down = std::atan2(run.x, -run.v);  // x cos t + v sin t = 0
  const MachineRun longer = run_of(scene, begin + 2 * half + 1);
  const auto impacts = those(longer, Told::impact, Side::lower), rests = those(longer, Told::rest, Side::lower);
  ASSERT_EQ(impacts.size(), 1u);
  ASSERT_EQ(rests.size(), 2u);
  expect_near(impacts[0].time, begin + half + down, 1e-14L);
  expect_near(impacts[0].velocity, -std::hypot(run.x, run.v), 1e-14L);
  expect_near(rests[1].until, begin + 2 * half), expect_near(longer.x, 1 - std::cos(1.0L), 1e-14L);
}

/// Pressed ever less along a straight line, and more again from a corner at which nothing presses.
TEST(Machine, rests_on_through_a_corner_at_which_the_force_is_gone) {
  MachineScene scene{
      .stiffness = 0, .forcing = 1, .frequency = 0.9, .load = -1, .shape = ForceShape::triangle, .lower = 0};
  EXPECT_EQ(only(run_of(scene, 40), Told::rest, Side::lower).until, 40);
  scene.load = -0.5;
  const MachineRun run = run_of(scene, 2.5);
  expect_near(only(run, Told::rest, Side::lower).until, pi / 4 / Real(0.9));
}

MachineScene with_stops_and_friction() {
  return {.damping = 0.05,
          .forcing = 1.25,
          .frequency = 0.7,
          .phase = 0.5,
          .load = 0.125,
          .friction = 0.1,
          .static_friction = 0.2,
          .lower = -0.5,
          .upper = 0.75,
          .restitution_lower = 0.7,
          .restitution_upper = 0.8,
          .x = 0.25};
}

TEST(Machine, moves_under_the_steepest_triangle_as_under_the_flattest_trapezoid) {
  MachineScene scene = with_stops_and_friction();
  scene.shape = ForceShape::triangle;
  const MachineRun one = run_of(scene, 60);
  scene.shape = ForceShape::trapezoid, scene.rise = 0.5;
  const MachineRun other = run_of(scene, 60);
  ASSERT_GT(one.events.size(), 30u);
  ASSERT_EQ(one.events.size(), other.events.size());
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    EXPECT_EQ(one.events[i].kind, other.events[i].kind);
    expect_near(one.events[i].time, other.events[i].time, 1e-18L);
    expect_near(one.events[i].before, other.events[i].before, 1e-18L);
  }
}

/// A half-sine less the one half a period later is the sine; pulses of 2 under a load of -1 are a square wave.
TEST(Machine, adds_shapes_up) {
  MachineScene scene{.damping = 0.05, .forcing = 1, .frequency = 1.3, .phase = 0.5, .shape = ForceShape::half_sine};
  const MachineRun early = run_of(scene, 30);
  scene.phase += static_cast<double>(pi);
  const MachineRun late = run_of(scene, 30);
  scene.phase = 0.5, scene.shape = ForceShape::sine;
  expect_near(early.x - late.x, run_of(scene, 30).x);

  scene = with_stops_and_friction();
  scene.shape = ForceShape::square, scene.duty = 0.375;
  const MachineRun square = run_of(scene, 60);
  scene.shape = ForceShape::pulse, scene.load -= scene.forcing, scene.forcing *= 2;
  const MachineRun pulse = run_of(scene, 60);
  ASSERT_GT(square.events.size(), 30u);
  ASSERT_EQ(square.events.size(), pulse.events.size());
  for (std::size_t i = 0; i < square.events.size(); ++i)
    expect_near(square.events[i].time, pulse.events[i].time, 1e-18L);
}

/// The work of a square wave is f times the ways of its pieces, that of the load is its own times the whole way.
TEST(Machine, keeps_its_energy_but_for_the_work_of_a_square_wave_and_losses) {
  MachineScene scene = with_stops_and_friction();
  scene.shape = ForceShape::square, scene.duty = 0.375;
  const Real f = scene.forcing, period = 2 * pi / Real(scene.frequency), begun = 0.5L / (2 * pi);
  Real work = 0, x = scene.x;
  for (int i = 0; i < 10; ++i) {
    const Real periods = i % 2 == 0 ? i / 2.0L + 0.375L : (i + 1) / 2.0L;
    const MachineRun run = run_of(scene, (periods - begun) * period);
    work += (i % 2 == 0 ? f : -f) * (run.x - x), x = run.x;
    expect_near(run.stored + run.damped + run.struck + run.rubbed, work + 0.125L * (x - Real(scene.x)), 1e-14L);
  }
}

// A loose mass.

/// Pressed by the lower wall while the housing gains speed, let go as the force turns round; then z'' = f.
TEST(Machine, lets_a_loose_mass_go_as_the_force_jumps) {
  const MachineScene scene{.stiffness = 0,
                           .forcing = 3,
                           .frequency = 0.75,
                           .phase = 1,
                           .shape = ForceShape::square,
                           .loose_mass = 0.5,
                           .wall_lower = -0.5,
                           .wall_upper = 0.5,
                           .z = -0.5};
  const Real jump = (pi - 1) / 0.75L, flight = std::sqrt(2 / 3.0L), v = 3 / 1.5L * jump;
  const MachineRun run = run_of(scene, jump + flight + 0.01L);
  ASSERT_GE(run.events.size(), 3u);
  EXPECT_EQ(run.events[0].kind, Kind::press);
  EXPECT_EQ(run.events[1].kind, Kind::release);
  expect_near(run.events[1].time, jump), expect_near(run.events[1].main_before, v);
  EXPECT_EQ(run.events[2].kind, Kind::wall_impact);
  expect_near(run.events[2].time, jump + flight), expect_near(run.events[2].before, 3 * flight);
}

/// Held in its housing without a force; a pulse of 2 needs 1 to take it along, friction has 7/8. Then it is as fast as
/// its housing, which it brakes, after z'' = -1/4 for half a period of 1 and 7/4 for a seventh of that.
TEST(Machine, slides_in_its_housing_as_the_force_jumps) {
  const MachineScene scene{.stiffness = 0,
                           .forcing = 2,
                           .frequency = static_cast<double>(2 * pi),
                           .phase = 4,
                           .shape = ForceShape::pulse,
                           .loose_mass = 1,
                           .wall_lower = -0.5,
                           .wall_upper = 0.5,
                           .loose_friction = 0.875,
                           .loose_static = 0.875};
  const Real jump = 1 - 4 / (2 * pi), together = jump + 0.5L + 0.5L / 7;
  const MachineRun run = run_of(scene, jump + 0.75L);
  ASSERT_EQ(run.events.size(), 3u);
  EXPECT_EQ(run.events[0].kind, Kind::hold);
  EXPECT_EQ(run.events[1].kind, Kind::hold_end);
  EXPECT_EQ(run.events[2].kind, Kind::hold);
  expect_near(run.events[1].time, jump), expect_near(run.events[2].time, together);
  expect_near(run.v, 0.5L);
  expect_near(run.z, -0.25L * 0.25L / 2 * (1 + 1 / 7.0L));
}

}  // namespace
}  // namespace clatter::hard::machine_force_events_test
