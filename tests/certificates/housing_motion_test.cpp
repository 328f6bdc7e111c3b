#include "certificates/recorded_motion.hpp"

#include <gtest/gtest.h>

#include "certified_run.hpp"

namespace clatter::certificates::housing_motion_test {
namespace {

using Kind = motion::Event::Kind;

RecordedEvent<4> impact(Side side, double time, double before, double after) {
  return {{Kind::impact, side, time, before, 0.0, after}};
}
RecordedEvent<4> press(Side side, double time, double length) { return {{Kind::rest, side, time, 0.0, length}}; }

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

/// A mass of 0.3 thrown about by a housing with one wall, onto which its own load brings it back.
point::Problem thrown() {
  point::Problem problem;
  problem.oscillator = {.damping = 0.5, .forcing = 1.0, .frequency = 0.8};
  problem.loose = {
      .ratio = 0.1, .lower = -0.5, .restitution_lower = 0.2, .restitution_upper = 0.2, .load = -0.6, .place = 0.1};
  return problem;
}

/// The derivative of the whole motion is that of runs beside it.
TEST(HousingMotion, the_derivative_is_that_of_the_difference_of_runs) {
  point::Problem problem = thrown();
  problem.loose.upper = 0.5, problem.loose.restitution_lower = 0.8, problem.loose.restitution_upper = 0.6;
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
      EXPECT_NEAR(motion->derivative[4 * i + j], slopes[i] / (2 * small), 1e-6) << i << ' ' << j;
  }
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
