// The simulator of `slide.hpp` against closed forms of motion with dry friction, and against numbers that were
// published or computed before it was written.

#include "hard/slide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hard/first_fall.hpp"

namespace clatter::hard::slide_test {
namespace {

using Kind = SlideEvent::Kind;
using Real = SlideEvent::Real;

constexpr Real pi = std::numbers::pi_v<Real>;
constexpr double none = std::numeric_limits<double>::infinity();

std::vector<SlideEvent> those(const SlideRun& run, Kind kind, Side side = Side::none) {
  std::vector<SlideEvent> found;
  std::copy_if(run.events.begin(), run.events.end(), std::back_inserter(found),
               [&](const SlideEvent& event) { return event.kind == kind && event.side == side; });
  return found;
}

void expect_near(Real value, Real expected, Real tolerance = 1e-15L) {
  EXPECT_LE(std::abs(value - expected), tolerance * (1 + std::abs(expected)))
      << static_cast<double>(value) << " for " << static_cast<double>(expected);
}

/// The product of (u - root), from its roots.
Series from_roots(const std::vector<Real>& roots) {
  Series p{1};
  for (const Real root : roots)
    for (std::size_t k = series_terms; k-- > 0;) p[k] = (k > 0 ? p[k - 1] : 0) - root * p[k];
  return p;
}

TEST(FirstFall, finds_the_first_of_two_close_zeros_and_no_zero_that_is_none) {
  for (const Real apart : {1e-1L, 1e-4L, 1e-8L}) {
    const auto found = first_fall(from_roots({0.3L, 0.3L + apart}));
    ASSERT_TRUE(found) << static_cast<double>(apart);
    expect_near(*found, 0.3L, 1e-18L / apart);
    Series lifted = from_roots({0.3L, 0.3L});
    lifted[0] += apart * apart;
    EXPECT_FALSE(first_fall(lifted)) << static_cast<double>(apart);
  }
  EXPECT_FALSE(first_fall(from_roots({1.1L, 1.2L})));
  expect_near(first_fall(from_roots({0.9L, 0.2L, 0.7L, 0.4L})).value(), 0.2L);
}

TEST(FirstFall, begins_at_an_exact_zero_by_its_direction) {
  expect_near(first_fall({0, 0, 1, -2}).value(), 0.5L);
  EXPECT_EQ(first_fall({0, 0, 0, -1, 5}).value(), 0);
  EXPECT_FALSE(first_fall({0, 1, -0.5L}));
}

/// A mass on its spring, at rest at a place, without damping or stops.
Scene free_from(double place, Friction friction) {
  return {.stops = {-none, none, 1, 1}, .start = {place, 0, 0}, .friction = friction};
}

TEST(Slide, loses_four_times_the_friction_a_turn_and_stops) {
  const SlideRun run = slide(free_from(5.3, {1, 1}), 20);
  const auto reversals = those(run, Kind::reversal), sticks = those(run, Kind::stick);
  ASSERT_EQ(reversals.size(), 2u);
  ASSERT_EQ(sticks.size(), 1u);
  expect_near(reversals[0].time, pi), expect_near(reversals[1].time, 2 * pi), expect_near(sticks[0].time, 3 * pi);
  const Real start = 5.3;
  expect_near(reversals[0].place, 2 - start), expect_near(reversals[1].place, start - 4);
  expect_near(sticks[0].place, 6 - start);
  expect_near(reversals[0].before, start - 2 + 1), expect_near(reversals[0].after, start - 2 - 1);
  expect_near(run.rubbed, (start * start - (6 - start) * (6 - start)) / 2);
  expect_near(run.stuck, 20 - 3 * pi), expect_near(run.lowest, 2 - start), expect_near(run.highest, start);
  EXPECT_TRUE(run.completed);
}

/// Den Hartog 1931: forced undamped motion without stops and without a stick has the amplitude (V^2 - (mu U)^2)^(1/2).
/// At its peak the force has the phase whose cosine is mu U/V.
TEST(Slide, keeps_the_amplitude_of_den_hartog) {
  struct Case {
    double nu, mu;
    Real amplitude;
  };
  for (const auto& [nu, mu, amplitude] : {Case{0.8, 0.3, 2.62610487572348L}, Case{1.3, 0.2, 1.39134462914783L}}) {
    const Real V = 1 / (1 - Real(nu) * nu), U = std::sin(pi / nu) / (nu * (1 + std::cos(pi / nu)));
    expect_near(std::sqrt(V * V - mu * mu * U * U), amplitude, 1e-14L);
    Scene scene = free_from(static_cast<double>(amplitude), {mu, mu});
    scene.oscillator.forcing = 1, scene.oscillator.frequency = nu;
    scene.start.phase = static_cast<double>(std::atan2(amplitude / V, mu * U / V));
    const SlideRun run = slide(scene, 40.5 * pi / nu);
    ASSERT_EQ(run.events.size(), 40u);
    for (std::size_t i = 0; i < 40; ++i) {
      expect_near(run.events[i].time, Real(i + 1) * pi / nu, 1e-12L);
      expect_near(run.events[i].place, i % 2 == 0 ? -amplitude : amplitude, 1e-12L);
    }
  }
}

/// A mass on a floor, without a spring.
Scene on_floor(double weight, double R, Friction friction) {
  return {.oscillator = {.load = -weight, .stiffness = 0},
          .stops = {0, none, R, 1},
          .start = {0, 1, 0},
          .friction = friction};
}

TEST(Slide, chatters_at_the_ratio_that_friction_leaves) {
  for (const double R : {0.5, 0.9, 1.0}) {
    const Real a = 2, mu = 0.5, rho = R * std::sqrt((a - mu) / (a + mu));
    const SlideRun run = slide(on_floor(2, R, {0.5, 0.75}), 20);
    const auto impacts = those(run, Kind::impact, Side::lower), rests = those(run, Kind::rest, Side::lower);
    ASSERT_GT(impacts.size(), 20u);
    ASSERT_EQ(rests.size(), 1u);
    for (std::size_t i = 0; i < impacts.size(); ++i)
      expect_near(-R * impacts[i].velocity / std::pow(rho, Real(i + 1)), 1, 1e-14L);
    const Real end = (1 / (a + mu) + 1 / std::sqrt(a * a - mu * mu)) / (1 - rho);
    expect_near(rests[0].time, end, 1e-12L);
    EXPECT_EQ(run.x, 0);
    expect_near(run.highest, 1 / (2 * (a + mu)));
  }
}

TEST(Slide, stays_off_the_floor_if_friction_holds_it_at_its_peak) {
  const SlideRun run = slide(on_floor(2, 0.9, {0.5, 2.5}), 20);
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].kind, Kind::stick);
  expect_near(run.events[0].time, 0.4L), expect_near(run.x, 0.2L);
}

TEST(Slide, is_released_at_the_phase_at_which_the_force_passes_the_static_level) {
  Scene scene = free_from(0.1, {0.3, 0.6});
  scene.oscillator.forcing = 1, scene.oscillator.frequency = 0.7;
  const SlideRun up = slide(scene, 1.5);
  ASSERT_EQ(up.events.size(), 1u);
  expect_near(up.events[0].until, std::asin(Real(0.6) + Real(0.1)) / Real(0.7));
  scene.start.phase = 2;  // sin 2 is beyond the level: it goes at once, up; from 3 on it waits for the other side
  EXPECT_EQ(slide(scene, 0.5).events.size(), 0u);
  EXPECT_GT(slide(scene, 0.1).x, 0.1L);
  scene.start.phase = 3;
  const SlideRun down = slide(scene, 3);
  ASSERT_EQ(down.events.size(), 1u);
  expect_near(down.events[0].until, (std::asin(Real(0.6) - Real(0.1)) + pi - 3) / Real(0.7));
  EXPECT_LT(down.v, 0);
}

TEST(Slide, rests_on_a_rigid_stop_until_the_pull_away_passes_the_static_level) {
  Scene scene = on_floor(0.2, 0.5, {0.1, 0.3});
  scene.oscillator.forcing = 1, scene.start.velocity = 0, scene.start.phase = -1;
  const SlideRun run = slide(scene, 1.8);
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].kind, Kind::rest);
  expect_near(run.events[0].until, std::asin(Real(0.2) + Real(0.3)) + 1);
  EXPECT_GT(run.v, 0);
}

/// Pressed by a speed into a soft stop without a damper: to and from the depth d at which
/// v^2 = kappa d^2 + 2 mu d (k = 0), then d' with kappa d'^2 = kappa d^2 - 2 mu d on leaving it.
TEST(Slide, loses_in_a_soft_stop_the_work_of_friction) {
  Scene scene{
      .oscillator = {.stiffness = 0}, .stops = {-none, 0, 1, 1, none, 100}, .start = {0, 1, 0}, .friction = {0.5, 0.5}};
  const Real kappa = 100, mu = 0.5, depth = (std::sqrt(mu * mu + kappa) - mu) / kappa;
  const SlideRun run = slide(scene, 0.4);
  ASSERT_EQ(run.events.size(), 3u);
  EXPECT_EQ(run.events[0].kind, Kind::touch);
  EXPECT_EQ(run.events[1].kind, Kind::reversal);
  EXPECT_EQ(run.events[2].kind, Kind::separation);
  expect_near(run.events[1].place, depth), expect_near(run.highest, depth);
  expect_near(run.events[1].before, -kappa * depth - mu, 1e-14L);
  expect_near(run.events[1].after, -kappa * depth + mu, 1e-14L);
  expect_near(run.events[2].velocity, -std::sqrt(1 - 4 * mu * depth), 1e-14L);
}

TEST(Slide, sticks_inside_a_soft_stop) {
  Scene scene{.oscillator = {.stiffness = 0},
              .stops = {-none, 0, 1, 1, none, 100},
              .start = {0.004, 0, 0},
              .friction = {0.3, 0.5}};
  const SlideRun run = slide(scene, 10);
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].kind, Kind::stick);
  EXPECT_EQ(run.stuck, 10);
  scene.start.displacement = 0.006;
  EXPECT_LT(slide(scene, 0.1).v, 0);
}

/// A soft stop without a spring to speak of beside its damper lets go of the mass beyond its position, and catches up.
TEST(Slide, outruns_a_damped_soft_stop_where_its_force_is_gone) {
  Scene scene{.stops = {-none, 0, 1, 1, none, 4, 0, 0.9}, .start = {-0.5, 1, 0}, .friction = {0.1, 0.1}};
  const SlideRun run = slide(scene, 3);
  const auto separations = those(run, Kind::separation, Side::upper);
  ASSERT_FALSE(separations.empty());
  EXPECT_LT(separations[0].velocity, 0);
  // at the separation kappa depth + 2 zeta kappa^(1/2) v = 0; the energy from there to x = 0 is that of a free slip
  const Real depth = -2 * Real(0.9) * 2 * separations[0].velocity / 4;
  SlideRun before = slide(scene, separations[0].time);
  expect_near(before.x, depth);
  expect_near(before.v, separations[0].velocity);
}

/// Stops at +-0.5 with a stick a period; the mirror image from the other start.
Scene with_a_stick(double start) {
  return {.oscillator = {.damping = 0.05, .forcing = 1, .frequency = 1.3},
          .stops = {-0.5, 0.5, 0.7, 0.7},
          .start = {start, 0, 0},
          .friction = {0.2, 0.2}};
}

TEST(Slide, settles_on_the_motion_with_a_stick_and_its_mirror_image) {
  const Real period = 2 * pi / Real(1.3);
  for (const auto& [start, sign] : {std::pair{0.0, 1}, {0.1, -1}}) {
    const SlideRun run = slide(with_a_stick(start), 100 * period);
    const Side above = sign > 0 ? Side::upper : Side::lower;
    expect_near(those(run, Kind::impact, above).back().velocity, sign * 0.940532086164330L, 1e-14L);
    expect_near(those(run, Kind::impact, opposite(above)).back().velocity, -sign * 0.718708034646616L, 1e-14L);
    const auto sticks = those(run, Kind::stick);
    const SlideEvent& stick = sticks[sticks.size() - 2];  // the last one may be cut by the end
    expect_near(stick.until - stick.time, 0.315340026143191L, 1e-14L);
    expect_near(stick.place, -sign * 0.327636229491487L, 1e-14L);
  }
}

/// The place of the stick after one that begins at a place.
Real next_place(Real place) {
  Scene scene = with_a_stick(static_cast<double>(place));
  const SlideRun settled = slide(with_a_stick(0), 100 * 2 * pi / Real(1.3));
  const auto sticks = those(settled, Kind::stick);
  scene.start.phase = static_cast<double>(std::fmod(Real(1.3) * sticks[sticks.size() - 2].time, 2 * pi)) + 0.01;
  return those(slide(scene, 9), Kind::stick).at(1).place;
}

TEST(Slide, maps_the_place_of_a_stick_with_the_known_derivative) {
  const double place = -0.327636229491487, step = 1e-5;
  const Real derivative = (next_place(place + step) - next_place(place - step)) / (2 * Real(step));
  expect_near(derivative, 0.267959696315445L, 1e-9L);  // the step's square, and the roundings of both places over it
}

/// The determinant of the flow over a time, by differences.
Real determinant(const Scene& scene, Real time) {
  const double step = 1e-5;
  const auto end = [&](double dx, double dv) {
    Scene moved = scene;
    moved.start.displacement += dx, moved.start.velocity += dv;
    const SlideRun run = slide(moved, time);
    return std::array{run.x, run.v};
  };
  const auto right = end(step, 0), left = end(-step, 0), faster = end(0, step), slower = end(0, -step);
  return ((right[0] - left[0]) * (faster[1] - slower[1]) - (right[1] - left[1]) * (faster[0] - slower[0])) /
         (4 * Real(step) * step);
}

TEST(Slide, reverses_with_the_quotient_of_the_accelerations_in_the_determinant) {
  Scene scene = free_from(-0.5, {0.3, 0.3});
  scene.oscillator = {.damping = 0.05, .forcing = 1, .frequency = 0.8};
  scene.start.velocity = -1.5;
  const Real period = 2 * pi / Real(0.8);
  const SlideRun run = slide(scene, period);
  const auto reversals = those(run, Kind::reversal);
  ASSERT_FALSE(reversals.empty());
  ASSERT_EQ(reversals.size(), run.events.size());
  Real expected = std::exp(-2 * Real(0.05) * period);
  for (const SlideEvent& reversal : reversals) expected *= reversal.after / reversal.before;
  expect_near(determinant(scene, period) / expected, 1, 1e-7L);  // the square of the step
  // settled, the product of both multipliers is known
  const SlideRun settled = slide(scene, 100 * period);
  const auto last = those(settled, Kind::reversal);
  Real product = std::exp(-2 * Real(0.05) * period);
  for (std::size_t i = last.size() - 2; i < last.size(); ++i) product *= last[i].after / last[i].before;
  expect_near(product, 0.20139584L, 1e-8L);
}

}  // namespace
}  // namespace clatter::hard::slide_test
