// Accuracy runs of scenes with a loose mass, whose impacts on walls are compared as those on stops are.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "accuracy/accuracies.hpp"
#include "accuracy/comparison.hpp"
#include "support/loose_scenes.hpp"
#include "support/random_machine.hpp"

namespace clatter::accuracy::accuracy_loose_mass_test {
namespace {

const AccuracyOptions once{.rounds = 1};

point::Problem pressed_scene() {
  point::Problem scene = support::pressed_scene();
  scene.time.window = 8;
  return scene;
}
point::Problem damper() {
  point::Problem scene = support::impact_damper();
  scene.loose.velocity = 0.3, scene.time.window = 16;  // from rest it strikes no wall for so long
  return scene;
}

TEST(LooseMassAccuracy, the_exact_method_is_exact_in_every_column) {
  for (const point::Problem& scene : {pressed_scene(), damper()}) {
    const PointAccuracy found = measure_accuracy(scene, one_of_each(), once);
    EXPECT_EQ(found.horizon, static_cast<double>(scene.time.window));
    EXPECT_GT(found.impacts, 10.0);
    const WorkPrecision& exact = row_of(found, TestedMethod::exact);
    for (const double error : {exact.contact_time, exact.contact_speed, exact.extrema, exact.harmonics})
      EXPECT_LT(error, 1e-12);  // roundings of contracting motion
    EXPECT_EQ(sum_of_faults(exact), 0.0);
    EXPECT_EQ(found.steady_periods, 1.0);
    const WorkPrecision& repeated = row_of(found, TestedMethod::steady_repetition);
    EXPECT_EQ(repeated.status, steady::Status::periodic);
    EXPECT_EQ(sum_of_faults(repeated), 0.0);
    EXPECT_LT(repeated.contact_speed, 1e-7);
    EXPECT_LT(row_of(found, TestedMethod::harmonics_exact).harmonics, 1e-12);
  }
}

TEST(LooseMassAccuracy, rests_are_the_times_for_which_a_wall_presses) {
  const PointAccuracy found = measure_accuracy(pressed_scene(), decades(TestedMethod::dopri5, 6, 11), once);
  EXPECT_GE(found.rests, 7.0);
  for (const WorkPrecision& row : found.rows) {
    EXPECT_EQ(sum_of_faults(row), 0.0) << row.trial.setting;
    EXPECT_LT(row.rest, 1e3 * row.trial.setting);
  }
  for (const auto error : {&WorkPrecision::contact_time, &WorkPrecision::contact_speed, &WorkPrecision::rest,
                           &WorkPrecision::extrema, &WorkPrecision::harmonics})
    EXPECT_NEAR(order_of(found, error), 1.0, 0.3);  // events cut steps at chance
}

TEST(LooseMassAccuracy, double_agrees_with_fifty_digits_to_the_end_of_random_scenes) {
  std::size_t rests = 0;
  for (std::uint64_t index = 100; index < 130; ++index) {
    const point::Problem scene = support::random_loose_scene(index);
    const RunRecord in_double = record_of(scene, 12), exact = reference_of(scene, 12);
    const Agreement agreement = agreement_of(in_double, exact, 1e-8);
    EXPECT_EQ(agreement.until, 12.0) << index;
    const ContactErrors errors = compare(in_double.events, agreement.events, 1.0);
    EXPECT_EQ(errors.missed + errors.extra + errors.rests_missed, 0u) << index;
    EXPECT_LT(errors.time, 1e-9) << index;
    rests += errors.rests_paired;
  }
  EXPECT_GT(rests, 5u);
}

/// Contacts and rests of both masses are told apart, and a section cuts those of both at once.
TEST(LooseMassAccuracy, beside_stops_and_friction_events_are_compared_with_those_of_their_mass) {
  std::size_t scenes = 0, paired = 0, rests = 0;
  for (std::uint64_t index = 0; index < 30; ++index) {
    const point::Problem scene = support::random_machine(index);
    const RunRecord in_double = record_of(scene, 12), exact = reference_of(scene, 12);
    const Agreement agreement = agreement_of(in_double, exact, 1e-7);
    if (agreement.until < 12) continue;  // both masses collapse on a stop, and rounding tells in which order
    ++scenes;
    const ContactErrors errors = compare(in_double.events, agreement.events, 1.0);
    EXPECT_EQ(errors.missed + errors.extra + errors.rests_missed, 0u) << index;
    EXPECT_LT(errors.time, 1e-8) << index;
    EXPECT_LT(errors.rest, 1e-7) << index;
    paired += errors.paired, rests += errors.rests_paired;
  }
  EXPECT_GE(scenes, 28u);
  EXPECT_GT(paired, 200u);
  EXPECT_GT(rests, 40u);
}

/// A chatter of five impacts: those up to a millionth of the fastest are its summed end.
TEST(LooseMassAccuracy, slow_impacts_before_a_rest_are_the_end_of_its_chatter) {
  using Kind = Event::Kind;
  std::vector<Event> events;
  for (const double speed : {1.0, 1e-3, 1e-6, 1e-9, 1e-12})
    events.push_back({Kind::impact, Side::lower, 2 - speed, -speed, 0.0, speed / 1000});
  events.push_back({Kind::rest, Side::lower, 2.0, 0.0, 1.0});
  const std::vector<Event> summed = with_slow_impacts_summed(events);
  ASSERT_EQ(summed.size(), 4u);
  EXPECT_EQ(summed[2].kind, Kind::chatter);
  EXPECT_EQ(summed[2].time, 2 - 1e-6);
  EXPECT_EQ(summed[2].end(), 2.0);
  EXPECT_EQ(summed[3].kind, Kind::rest);
  events.insert(events.end() - 1, {Kind::impact, Side::upper, 2.0, 1e-12});  // of the main mass
  for (Event& event : events) event.of_wall = event.side == Side::lower;
  EXPECT_EQ(with_slow_impacts_summed(events).size(), 5u);
  events.back().side = Side::upper;  // another wall
  EXPECT_EQ(with_slow_impacts_summed(events).size(), events.size());
}

}  // namespace
}  // namespace clatter::accuracy::accuracy_loose_mass_test
