// Derivatives of motion whose restitution depends on the speed, against central differences of runs in 50 digits.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iostream>
#include <vector>

#include "math/fifty_digits.hpp"
#include "point/exact_motion.hpp"
#include "point/reference_motion.hpp"
#include "support/loose_scenes.hpp"

namespace clatter::observables::stability_by_speed_test {
namespace {

using support::loose_scene;
using Law = Restitution<double>;
using Vector = motion::Four<double>;
using Matrix = std::array<Vector, 4>;  ///< of the upper left 2 x 2 numbers without a loose mass

Law by_knots(const std::vector<SpeedTable::Knot>& knots, double unit = 1) {
  Law law;
  law.table = kept(SpeedTable{knots}), law.unit = unit;
  return law;
}
Law by_power(double R, double exponent, double reference, double below = 0) {
  Law law(R);
  law.exponent = exponent, law.reference = reference, law.below = below;
  return law;
}
struct NamedLaw {
  const char* name;
  Law law;
};
std::vector<NamedLaw> every_law() {
  return {{"power", by_power(0.7, 0.2, 0.5)},
          {"steep power", by_power(0.6, 0.5, 0.8)},
          {"beyond a power", by_power(0.5, 0.9, 0.01)},
          {"falling", by_knots({{0, 0.9}, {5, 0.5}})},
          {"rising", by_knots({{0.1, 0.4}, {3, 0.8}, {4, 0.9}}, 0.7)},
          {"many knots", by_knots({{0.1, 0.9}, {0.2, 0.7}, {0.3, 0.75}, {0.5, 0.6}, {0.8, 0.7}, {1.3, 0.5}})},
          {"threshold", by_power(0.7, 0.2, 0.5, 1e-3)},
          {"slow ones stay", by_power(0.6, 0, 1, 0.02)}};
}

/// The state after a time in forcing periods, by a change of that at the start.
motion::Four<FiftyDigits> after(const point::Problem& scene, const Vector& change, double turns) {
  const auto exact = point::ReferenceMotion::of(scene);
  motion::State<FiftyDigits> state = motion::moved(exact->start(), change);
  point::ReferenceRecorder recorder;
  EXPECT_EQ(exact->run_for(state, FiftyDigits(turns), recorder), stepping::Outcome::completed);
  return motion::numbers_of(state, scene.loose);
}
/// The derivative of that by the start.
Matrix by_differences(const point::Problem& scene, double turns) {
  constexpr double step = 1e-18;
  Matrix derivative{};
  const std::size_t numbers = has_loose_mass(scene.loose) ? 4 : 2;
  for (std::size_t i = 0; i < numbers; ++i) {
    Vector change{};
    change[i] = step;
    const auto up = after(scene, change, turns);
    change[i] = -step;
    const auto down = after(scene, change, turns);
    for (std::size_t j = 0; j < numbers; ++j)
      derivative[j][i] = static_cast<double>(FiftyDigits((up[j] - down[j]) / (2 * step)));
  }
  return derivative;
}

/// The program's tangent map over the same time, how many impacts it has, and the slowest of them.
struct Tangent {
  Matrix map{};
  std::size_t impacts = 0;
  double slowest = 1;
  bool presses = false;  ///< a chatter on a wall ends, of which 50 digits would take too many impacts
};
Tangent tangent_of(const point::Problem& scene, double turns) {
  const auto exact = point::ExactMotion::of(scene);
  point::MotionRecorder recorder(exact->stops());
  recorder.keep_events(), recorder.watch.differentiate();
  if (has_loose_mass(scene.loose)) recorder.loose.emplace(scene);
  motion::State<double> state = exact->start();
  EXPECT_EQ(exact->run_for(state, turns, recorder), stepping::Outcome::completed);
  Tangent tangent;
  for (const motion::Event& event : recorder.events) {
    tangent.presses = tangent.presses || (event.lasts() && event.side != Side::none && recorder.loose);
    if (event.kind != motion::Event::Kind::impact) continue;
    ++tangent.impacts, tangent.slowest = std::min(tangent.slowest, std::abs(event.before));
  }
  const auto map = recorder.watch.derivative();
  tangent.map[0] = {map[0], map[1]}, tangent.map[1] = {map[2], map[3]};
  if (recorder.loose) tangent.map = recorder.loose->map();
  return tangent;
}
/// Whether they could be compared.
bool expect_tangent(const point::Problem& scene, double turns) {
  const auto [map, impacts, slowest, presses] = tangent_of(scene, turns);
  if (presses) return false;
  const Matrix known = by_differences(scene, turns);
  EXPECT_GE(impacts, 2u);
  double size = 1;
  for (const Vector& row : known)
    for (const double entry : row) size = std::max(size, std::abs(entry));
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)  // an instant is off by a rounding over the speed, the derivative by one more
      EXPECT_NEAR(map[j][i], known[j][i], 1e-13 * size / (slowest * slowest)) << j << i << ", " << slowest;
  return true;
}

/// Forced between stops with one law and another.
point::Problem between_stops(const Law& lower, const Law& upper) {
  point::Problem scene;
  scene.oscillator = {.damping = 0.1, .forcing = -1, .frequency = 0.9, .load = 0.05};
  scene.stops = {-0.5, 0.6, lower, upper};
  scene.start = {0.1, -0.7, 0.4};
  return scene;
}
/// A mass that is carried between walls with one law and another.
point::Problem carried(const Law& lower, const Law& upper) {
  point::Problem scene = loose_scene(0.3, 0.04, 0.5, 1.2, 0.5, 1);
  scene.loose.restitution_lower = lower, scene.loose.restitution_upper = upper;
  scene.start.velocity = 0.1, scene.loose.velocity = 0.4, scene.loose.load = 0.1;
  return scene;
}

TEST(StabilityBySpeed, of_motion_between_stops_is_that_of_differences) {
  std::size_t compared = 0;
  for (const auto& [name, law] : every_law()) {
    SCOPED_TRACE(name);
    point::Problem scene = between_stops(law, 0.8);
    compared += expect_tangent(scene, 2.3);
    scene.stops.restitution_lower = by_power(0.8, 0.1, 2), scene.stops.restitution_upper = law;
    compared += expect_tangent(scene, 2.3);
  }
  EXPECT_GE(compared, 16u);
  std::cout << compared << " compared\n";
}

TEST(StabilityBySpeed, under_friction_is_that_of_differences) {
  std::size_t compared = 0;
  for (const auto& [name, law] : every_law()) {
    SCOPED_TRACE(name);
    point::Problem scene = between_stops(law, law);
    scene.friction = {0.05, 0.06};
    compared += expect_tangent(scene, 2.3);
  }
  EXPECT_GE(compared, 8u);
  std::cout << compared << " compared\n";
}

TEST(StabilityBySpeed, of_a_loose_mass_is_that_of_differences) {
  std::size_t compared = 0;
  for (const auto& [name, law] : every_law()) {
    if (law.exponent > 0.5) continue;  // a chatter on a wall takes ten thousand million impacts
    SCOPED_TRACE(name);
    point::Problem scene = carried(law, law);
    compared += expect_tangent(scene, 2.3);
    scene.loose.restitution_lower = by_power(0.8, 0.1, 2);
    compared += expect_tangent(scene, 2.3);
    scene.loose.friction = 0.01, scene.loose.friction_static = 0.012;
    compared += expect_tangent(scene, 1.8);
  }
  EXPECT_GE(compared, 12u);
  std::cout << compared << " compared\n";
}

/// The sums of the multipliers, of their squares and of their cubes are traces of the map of a period and its powers.
void expect_multipliers(const point::Problem& scene, std::size_t numbers) {
  point::Problem steady = scene;
  steady.time.tolerance = 1e-14, steady.time.max_periods = 5000;
  steady.observe.impacts = true;
  const point::PointResult result = support::observed(steady);
  ASSERT_EQ(result.status, steady::Status::periodic);
  steady.start.displacement = result.end.displacement, steady.start.velocity = result.end.velocity;
  steady.loose.place = result.end.loose_place, steady.loose.velocity = result.end.loose_velocity;
  EXPECT_GE(result.log.size(), 1u);
  const Matrix map = by_differences(steady, result.observed_turns);
  Matrix power = map;
  for (int n = 1; n <= 3; ++n) {
    std::complex<double> sum = 0;
    double trace = 0, size = 1;
    for (std::size_t i = 0; i < numbers; ++i) {
      const std::complex<double> multiplier(result.multiplier_re[i], result.multiplier_im[i]);
      sum += std::pow(multiplier, n), trace += power[i][i], size = std::max(size, std::pow(std::abs(multiplier), n));
    }
    EXPECT_NEAR(sum.real(), trace, 1e-10 * size) << n;
    EXPECT_NEAR(sum.imag(), 0, 1e-10 * size) << n;
    Matrix next{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k) next[i][j] += power[i][k] * map[k][j];
    power = next;
  }
}

TEST(StabilityBySpeed, of_periodic_motion_has_the_multipliers_of_differences) {
  std::size_t kinds = 0;
  for (const auto& [name, law] : every_law())
    for (const double nu : {0.9, 1.6}) {
      SCOPED_TRACE(name);
      point::Problem scene = between_stops(law, law);
      scene.oscillator.frequency = nu;
      expect_multipliers(scene, 2), ++kinds;
    }
  EXPECT_EQ(kinds, 16u);
}

TEST(StabilityBySpeed, of_periodic_motion_with_a_loose_mass_has_the_multipliers_of_differences) {
  for (const auto& [name, law] : every_law()) {
    SCOPED_TRACE(name);
    point::Problem scene = loose_scene(0.1, 0.1, 0.3, 1.5, 0.8, 1);
    scene.loose.restitution_lower = scene.loose.restitution_upper = law;
    scene.loose.velocity = 0.5;
    expect_multipliers(scene, 4);
  }
}

}  // namespace
}  // namespace clatter::observables::stability_by_speed_test
