// Contacts that double has proved and more digits have polished are those that more digits find by themselves.

#include "stepping/guided.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "math/double_double.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/random.hpp"

namespace clatter::stepping::guided_test {
namespace {

constexpr Effects light = effect_sets::with_friction(Damping::light, Forcing::secular),
                  heavy = effect_sets::with_friction(Damping::heavy, Forcing::regular);

/// Counts impacts and rests.
struct Counter : NoObserver {
  int impacts = 0, rests = 0;
  void event(const motion::Event& event) { ++(event.lasts() ? rests : impacts); }
};

/// A scene in which impacts, grazes, chatter and rests come up; its stops are near each other, far apart, or one.
BasicScene<DoubleDouble> any_scene(support::Random& random, bool rotates) {
  Scene scene;
  scene.oscillator = {.damping = rotates ? random.uniform(0, 0.5) : random.uniform(1.01, 2),
                      .forcing = random.sign() * random.uniform(0.5, 2),
                      .frequency = random.logarithmic(0.1, 5)};
  if (random.happens(0.2))
    scene.oscillator.frequency = 1 + 1e-3 * random.uniform(-1, 1), scene.oscillator.damping *= 0.01;
  scene.oscillator.load = random.happens(0.5) ? random.uniform(-0.5, 0.5) : 0.0;
  scene.oscillator.stiffness = random.logarithmic(0.2, 5);
  if (!rotates) scene.oscillator.damping *= std::sqrt(scene.oscillator.stiffness);
  if (rotates) scene.oscillator.damping *= 0.5 * std::sqrt(scene.oscillator.stiffness);
  scene.stops = {-random.logarithmic(1e-3, 2), random.logarithmic(1e-3, 2), random.uniform(0.1, 0.9),
                 random.uniform(0.1, 0.9)};
  if (random.happens(0.3)) scene.stops.upper = std::numeric_limits<double>::infinity();
  return with_numbers<DoubleDouble>(scene);
}

/// Runs both from the same state over each of some forcing periods.
template <Effects E>
void expect_same_motion(bool rotates, double& evaluations, double& guided_evaluations) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    support::Random random(66, i);
    const auto scene = any_scene(random, rotates);
    Exact<DoubleDouble, E> exact(scene, scene.stops, {}, motion::ChatterRule<DoubleDouble>::as_in_double());
    Guided<DoubleDouble, E> guided(scene, scene.stops, {}, motion::ChatterRule<DoubleDouble>::as_in_double());
    motion::State<DoubleDouble> state;
    for (int period = 0; period < 8; ++period) {
      motion::State<DoubleDouble> other = state;
      Counter of_exact, of_guided;
      ASSERT_EQ(advance_to_section(exact, state, 0, of_exact), Outcome::completed) << i;
      ASSERT_EQ(advance_to_section(guided, other, 0, of_guided), Outcome::completed) << i;
      EXPECT_EQ(of_exact.impacts, of_guided.impacts) << i;
      EXPECT_EQ(of_exact.rests, of_guided.rests) << i;
      // both round at each contact, by 1e-31 or so, and softly met stops stretch that by some digits
      const DoubleDouble size = abs(state.x) + abs(state.v) + 1;
      EXPECT_LE(abs(state.x - other.x), 1e-25 * size) << i << ' ' << period;
      EXPECT_LE(abs(state.v - other.v), 1e-25 * size) << i << ' ' << period;
    }
    evaluations += exact.evaluations(), guided_evaluations += guided.evaluations();
  }
}

TEST(Guided, MovesAsExactDoes) {
  double evaluations = 0, guided = 0;
  expect_same_motion<light>(true, evaluations, guided);
  EXPECT_LT(guided, evaluations / 3);  // double proves most contacts
}

TEST(Guided, MovesAsExactDoesUnderHeavyDamping) {
  double evaluations = 0, guided = 0;
  expect_same_motion<heavy>(false, evaluations, guided);
  EXPECT_LT(guided, evaluations / 2);
}

TEST(Guided, LeavesAGrazeToTheFullSearch) {
  // the steady motion touches the stop with hardly any speed: double can't tell whether it does
  Scene scene;
  scene.oscillator = {.damping = 0.1, .forcing = 1.0, .frequency = 0.7};
  const double amplitude = steady_response(scene.oscillator).amplitude;
  for (const double past : {1e-18, -1e-18}) {
    auto in_digits = with_numbers<DoubleDouble>(scene);
    const Response<DoubleDouble> response =
        response_to(1 - in_digits.oscillator.frequency * in_digits.oscillator.frequency, in_digits.oscillator.damping,
                    in_digits.oscillator.forcing, in_digits.oscillator.frequency);
    in_digits.stops.upper = sqrt(response.in_phase * response.in_phase + response.quadrature * response.quadrature);
    EXPECT_NEAR(static_cast<double>(in_digits.stops.upper), amplitude, 1e-15);
    in_digits.stops.upper += past * in_digits.stops.upper;
    Guided<DoubleDouble, light> guided(in_digits);
    motion::State<DoubleDouble> state;
    state.x = response.quadrature, state.v = in_digits.oscillator.frequency * response.in_phase;
    Counter counter;
    ASSERT_EQ(advance_to_section(guided, state, 0, counter), Outcome::completed);
    EXPECT_EQ(counter.impacts, past < 0 ? 1 : 0);
  }
}

}  // namespace
}  // namespace clatter::stepping::guided_test
