#include "certificates/recorded_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "certified_run.hpp"

namespace clatter::certificates::housing_motion_test {
namespace {

using Kind = motion::Event::Kind;

RecordedEvent<4> impact(Side side, double time, double before, double after) {
  RecordedEvent<4> event{{Kind::impact, side, time, before, 0.0, after}};
  event.of_wall = true;
  return event;
}
RecordedEvent<4> press(Side side, double time, double length) {
  RecordedEvent<4> event{{Kind::rest, side, time, 0.0, length}};
  event.of_wall = true;
  return event;
}

TEST(HousingEvents, impacts_a_thousand_times_slower_than_the_first_are_one_chatter) {
  std::vector<RecordedEvent<4>> events;
  double time = 1.0, speed = 0.5;
  for (int i = 0; i < 20; ++i, time += speed, speed /= 4)
    events.push_back(impact(Side::upper, time, speed, -speed / 4));
  events.push_back(press(Side::upper, time, 0.5));
  const auto joined = with_chatters(events);
  ASSERT_EQ(joined.size(), 7U);  // 0.5 4^-5 is the first below 0.5/1000
  EXPECT_EQ(joined[4].after, -0.5 / 1024);
  EXPECT_EQ(joined[5].kind, Kind::chatter);
  EXPECT_EQ(joined[5].time, joined[4].time);
  EXPECT_EQ(joined[5].end(), time);
  EXPECT_TRUE(joined[6].is_rest());
}

TEST(HousingEvents, a_press_after_an_impact_without_a_rebound_or_after_none_has_no_chatter) {
  const auto joined = with_chatters({press(Side::lower, 0.0, 0.5), impact(Side::upper, 1.0, 0.5, -0.1),
                                     impact(Side::lower, 2.0, -0.5, 0.0), press(Side::lower, 2.0, 1.0)});
  ASSERT_EQ(joined.size(), 4U);
  EXPECT_EQ(joined[2].kind, Kind::impact);
}

TEST(HousingEvents, a_chatter_begins_after_the_last_event_of_the_other_mass) {
  std::vector<RecordedEvent<4>> events;
  double time = 1.0, speed = 0.5;
  for (int i = 0; i < 20; ++i, time += speed, speed /= 4) {
    events.push_back(impact(Side::upper, time, speed, -speed / 4));
    if (i == 2) events.push_back({{Kind::impact, Side::upper, time + speed / 2, 0.3, 0.0, -0.3}});
  }
  events.push_back(press(Side::upper, time, 0.5));
  const auto joined = with_chatters(events);
  ASSERT_EQ(joined.size(), 11U);  // 0.5 4^-8 is the first below 0.5 4^-3/1000
  EXPECT_FALSE(joined[3].of_wall);
  EXPECT_EQ(joined[8].after, -0.5 / (1 << 16));
  EXPECT_EQ(joined[9].kind, Kind::chatter);
  EXPECT_TRUE(joined[9].of_wall);
}

/// A mass of 0.3 thrown about by a housing with one wall, onto which its own load brings it back.
point::Problem thrown() {
  point::Problem problem;
  problem.oscillator = {.damping = 0.5, .forcing = 1.0, .frequency = 0.8};
  problem.loose = {
      .ratio = 0.1, .lower = -0.5, .restitution_lower = 0.2, .restitution_upper = 0.2, .load = -0.6, .place = 0.1};
  return problem;
}

void expect_derivative_of_runs(const point::Problem& problem) {
  const auto motion = recorded_in_housing(problem, 1.0);
  ASSERT_TRUE(motion);
  EXPECT_GT(motion->events.size(), 2U);
  constexpr double small = 1e-6;
  for (std::size_t j = 0; j < 4; ++j) {
    const auto beside = [&](double by) {
      point::Problem moved = problem;
      double* const numbers[] = {&moved.start.displacement, &moved.start.velocity, &moved.loose.place,
                                 &moved.loose.velocity};
      *numbers[j] += by;
      return recorded_in_housing(moved, 1.0)->end;
    };
    const MachineState up = beside(small), down = beside(-small);
    const double slopes[] = {up.x - down.x, up.v - down.v, up.z - down.z, up.w - down.w};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(motion->derivative[4 * i + j], slopes[i] / (2 * small), 2e-6) << i << ' ' << j;
  }
}

point::Problem between_walls() {
  point::Problem problem = thrown();
  problem.loose.upper = 0.5, problem.loose.restitution_lower = 0.8, problem.loose.restitution_upper = 0.6;
  return problem;
}
point::Problem between_stops() {
  point::Problem problem = between_walls();
  problem.oscillator.damping = 0.05;
  problem.stops.lower = -0.4, problem.stops.upper = 0.4;
  problem.stops.restitution_lower = problem.stops.restitution_upper = 0.7;
  return problem;
}

/// The derivative of the whole motion is that of runs beside it.
TEST(HousingMotion, the_derivative_is_that_of_the_difference_of_runs) {
  expect_derivative_of_runs(between_walls());
  expect_derivative_of_runs(between_stops());
}

TEST(CertifiedInHousing, events_of_both_masses_are_one_list_in_order) {
  point::Problem problem = between_stops();
  problem.time.mode = steady::Mode::transient, problem.time.duration = 6.0;
  const auto point = certified_run(problem);
  ASSERT_TRUE(point.certificate);
  const auto& events = point.certificate->events;
  EXPECT_TRUE(std::ranges::is_sorted(events, {}, [](const ClaimedEvent& event) { return event.time.value; }));
  EXPECT_TRUE(std::ranges::any_of(events, &ClaimedEvent::of_wall));
  EXPECT_FALSE(std::ranges::all_of(events, &ClaimedEvent::of_wall));
}

/// A main mass at rest on its stop that a loose one strikes towards it meets it at once: no order of the two is
/// claimed.
TEST(CertifiedInHousing, two_events_at_one_instant_have_no_claim) {
  point::Problem problem;
  problem.oscillator = {.forcing = 0.1, .frequency = 1.0, .load = 2.0};
  problem.stops.upper = 0.5, problem.stops.restitution_upper = 0.5;
  problem.start.displacement = 0.5;
  problem.loose = {.ratio = 0.3, .upper = 0.5, .restitution_upper = 0.5, .place = 0.0, .velocity = 0.5};
  problem.time.mode = steady::Mode::transient, problem.time.duration = 1.5;
  const auto point = certified_run(problem);
  EXPECT_FALSE(point.certificate);
  EXPECT_EQ(point.without, Without::one_instant);
}

/// The start is all that a verifier reads: a run from it has the claimed events to well within their errors.
TEST(CertifiedInHousing, a_run_from_the_stated_start_has_the_claimed_events) {
  const point::Problem problem = thrown();
  const auto point = certified_run(problem);
  ASSERT_TRUE(point.certificate);
  const Certificate& certificate = *point.certificate;
  EXPECT_EQ(certificate.pressed, Side::lower);
  EXPECT_EQ(certificate.events.front().kind, Kind::rest);
  EXPECT_EQ(certificate.events.back().kind, Kind::rest);
  ASSERT_EQ(certificate.period->multipliers->size(), 4U);
  EXPECT_EQ((*certificate.period->multipliers)[3].re, 0.0);
  EXPECT_EQ((*certificate.period->multipliers)[3].error, 0.0);
  point::Problem again = problem;
  again.start = certificate.scene.start, again.loose = certificate.scene.loose;
  again.start.phase += again.oscillator.frequency * certificate.time;
  const auto motion = recorded_in_housing(again, static_cast<double>(certificate.period->periods));
  ASSERT_TRUE(motion);
  ASSERT_EQ(motion->events.size(), certificate.events.size());
  for (std::size_t i = 0; i < motion->events.size(); ++i) {
    const ClaimedEvent& claim = certificate.events[i];
    EXPECT_EQ(motion->events[i].kind, claim.kind);
    EXPECT_LE(std::abs(motion->events[i].time + certificate.time - claim.time.value), claim.time.error / 4) << i;
  }
}

}  // namespace
}  // namespace clatter::certificates::housing_motion_test
