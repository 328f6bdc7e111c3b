#include "certificates/certified_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "certificates/recorded_motion.hpp"
#include "certified_run.hpp"

namespace clatter::certificates::certified_point_test {
namespace {

using Kind = motion::Event::Kind;

point::Problem between_stops(double nu, double stop) {
  point::Problem problem;
  problem.oscillator = {.damping = 0.1, .forcing = -1.0, .frequency = nu};
  problem.stops = {.lower = -stop, .upper = stop, .restitution_lower = 0.7, .restitution_upper = 0.7};
  return problem;
}

Certificate certificate_of(const point::Problem& problem) {
  auto point = certified_run(problem);
  EXPECT_TRUE(point.certificate);
  return point.certificate.value_or(Certificate{});
}

/// The largest error of a claimed event's time against events that are computed anew, over the claimed error.
double worst_time(const Certificate& certificate, const std::vector<RecordedEvent<2>>& events) {
  double worst = 0.0;
  EXPECT_EQ(certificate.events.size(), events.size());
  for (std::size_t i = 0; i < std::min(events.size(), certificate.events.size()); ++i) {
    const ClaimedEvent& claimed = certificate.events[i];
    EXPECT_EQ(claimed.kind, events[i].kind);
    worst = std::max(worst, std::abs(claimed.time.value - certificate.time - events[i].time) / claimed.time.error);
  }
  return worst;
}

/// The start is all that a verifier reads: a run from it alone, with the phase that it has by its time, has the claimed
/// events to well within their errors.
TEST(CertifiedPoint, a_run_from_the_stated_start_has_the_claimed_events) {
  for (const double nu : {0.6, 1.1}) {
    point::Problem problem = between_stops(nu, 0.5);
    const Certificate certificate = certificate_of(problem);
    ASSERT_TRUE(certificate.period);
    ASSERT_EQ(certificate.released, Side::none);
    problem.start = certificate.scene.start;
    problem.start.phase += nu * certificate.time;
    const auto motion = recorded(problem, static_cast<double>(certificate.period->periods));
    ASSERT_TRUE(motion);
    EXPECT_GT(motion->events.size(), 1U);
    EXPECT_LT(worst_time(certificate, motion->events), 0.1);
  }
}

/// A release is the start of motion that rests, and its last event is the rest that leads there again.
TEST(CertifiedPoint, motion_that_rests_begins_with_a_release) {
  const point::Problem problem = between_stops(0.3, 0.05);
  const Certificate certificate = certificate_of(problem);
  ASSERT_TRUE(certificate.period);
  EXPECT_EQ(certificate.released, Side::lower);
  EXPECT_EQ(certificate.events.back().kind, Kind::rest);
  EXPECT_EQ(certificate.events.back().side, Side::lower);
  const double end = certificate.time + 2 * pi<double>() / 0.3;
  EXPECT_NEAR(certificate.events.back().then.value, end, certificate.events.back().then.error);
  // the force that presses the mass, -sin(nu tau) - x, falls to 0
  EXPECT_NEAR(-std::sin(0.3 * certificate.time) + 0.05, 0.0, 1e-13);
  EXPECT_EQ(certificate.period->word, "L*U*");
  for (const ClaimedMultiplier& multiplier : *certificate.period->multipliers) EXPECT_EQ(multiplier.re, 0.0);
}

TEST(CertifiedPoint, a_mass_that_is_never_released_rests_for_a_whole_period) {
  point::Problem problem = between_stops(1.0, 0.5);
  problem.oscillator.load = 3.0;
  const Certificate certificate = certificate_of(problem);
  ASSERT_TRUE(certificate.period);
  EXPECT_EQ(certificate.released, Side::none);
  EXPECT_EQ(certificate.scene.start.displacement, 0.5);
  EXPECT_EQ(certificate.scene.start.velocity, 0.0);
  ASSERT_EQ(certificate.events.size(), 1U);
  EXPECT_EQ(certificate.events[0].kind, Kind::rest);
  EXPECT_NEAR(certificate.events[0].then.value, 2 * pi<double>(), 1e-14);
}

TEST(CertifiedPoint, motion_without_a_claim_says_why) {
  point::Problem free = between_stops(1.0, 0.5);
  free.oscillator = {};
  free.start = {0.0, 1.0, 0.0};
  EXPECT_EQ(certified_run(free).without, Without::force);
}

/// A chatter that the end cuts has an end that isn't in the motion.
TEST(CertifiedPoint, a_transient_that_ends_within_a_chatter_has_no_claim) {
  point::Problem problem = between_stops(0.3, 0.05);
  problem.time.mode = steady::Mode::transient;
  problem.time.duration = 20.0;
  const Certificate whole = certificate_of(problem);
  const auto chatter = std::ranges::find(whole.events, Kind::chatter, &ClaimedEvent::kind);
  ASSERT_NE(chatter, whole.events.end());
  problem.time.duration = (chatter->time.value + chatter->then.value) / 2;
  EXPECT_EQ(certified_run(problem).without, Without::cut_chatter);
}

}  // namespace
}  // namespace clatter::certificates::certified_point_test
