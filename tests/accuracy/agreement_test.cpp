// The time over which a run in double and one in 50 digits agree, and their common events.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "accuracy/comparison.hpp"
#include "support/runs.hpp"

namespace clatter::accuracy::agreement_test {
namespace {

Event impact(double time, Side side = Side::upper) { return {Event::Kind::impact, side, time, 1.0, 0.0}; }

RunRecord record(std::vector<Event> events, double duration = 5) {
  RunRecord record;
  record.outcome = stepping::Outcome::completed, record.events = std::move(events), record.duration = duration;
  return record;
}

std::size_t count(const std::vector<Event>& events, Event::Kind kind) {
  return static_cast<std::size_t>(std::ranges::count(events, kind, &Event::kind));
}

TEST(Agreement, of_the_same_events_lasts_to_the_end) {
  const RunRecord one = record({impact(1), impact(2, Side::lower), {Event::Kind::rest, Side::upper, 3, 0, 1}});
  const Agreement agreement = agreement_of(one, one, 1e-8);
  EXPECT_EQ(agreement.until, 5.0);
  EXPECT_EQ(agreement.events.size(), 3u);
  EXPECT_EQ(agreement_of(record({}), record({}), 1e-8).until, 5.0);
}

TEST(Agreement, ends_with_the_first_time_that_is_off_by_more_than_the_room) {
  const RunRecord exact = record({impact(1), impact(2), impact(3)}),
                  other = record({impact(1 + 1e-9), impact(2 - 1e-6), impact(3)});
  for (const auto& [tolerance, until, events] : {std::tuple{1e-5, 5.0, 3u}, {1e-7, 2 - 1e-6, 1u}, {1e-10, 1.0, 0u}}) {
    const Agreement agreement = agreement_of(other, exact, tolerance);
    EXPECT_EQ(agreement.until, until) << "the earlier of both";
    ASSERT_EQ(agreement.events.size(), events);
    for (std::size_t i = 0; i < events; ++i) EXPECT_EQ(agreement.events[i].time, exact.events[i].time);
  }
}

TEST(Agreement, ends_at_another_stop_or_another_kind_of_event) {
  const RunRecord exact = record({impact(1), impact(2), impact(3)});
  EXPECT_EQ(agreement_of(record({impact(1), impact(2, Side::lower), impact(3)}), exact, 0.1).until, 2.0);
  EXPECT_EQ(agreement_of(record({impact(1), {Event::Kind::rest, Side::upper, 2, 0, 1}, impact(3)}), exact, 0.1).until,
            2.0);
}

TEST(Agreement, ends_at_an_impact_that_one_of_them_lacks) {
  const RunRecord all = record({impact(1), impact(2), impact(3)});
  for (const RunRecord& fewer :
       {record({impact(2), impact(3)}), record({impact(1), impact(3)}), record({impact(1), impact(2)}), record({})}) {
    const double lacking = fewer.events.empty() || fewer.events[0].time != 1 ? 1
                           : fewer.events.back().time == 2                   ? 3
                                                                             : 2;
    const auto common = static_cast<std::size_t>(lacking) - 1;
    for (const Agreement& agreement : {agreement_of(fewer, all, 1e-8), agreement_of(all, fewer, 1e-8)}) {
      EXPECT_EQ(agreement.until, lacking);
      EXPECT_EQ(agreement.events.size(), common);
    }
  }
}

TEST(Agreement, is_not_broken_by_an_event_at_the_very_end) {
  // a rounding decides whether it is before the end or after
  for (const double time : {5.0, 5 * (1 - 1e-15)}) {
    EXPECT_EQ(agreement_of(record({impact(1), impact(time)}), record({impact(1)}), 1e-8).until, 5.0);
    EXPECT_EQ(agreement_of(record({impact(1)}), record({impact(1), impact(time)}), 1e-8).until, 5.0);
  }
}

TEST(Agreement, leaves_out_the_impacts_of_fifty_digits_in_a_chatter_that_a_double_has_completed) {
  const point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5);
  const double duration = 4 * std::numbers::pi;  // one forcing period, with one chatter and the rest after it
  const RunRecord in_double = record_of(scene, duration), exact = reference_of(scene, duration);
  const auto impacts = count(in_double.events, Event::Kind::impact);
  ASSERT_EQ(count(in_double.events, Event::Kind::chatter), 1u);
  ASSERT_EQ(count(in_double.events, Event::Kind::rest), 1u);
  ASSERT_GT(count(exact.events, Event::Kind::impact), impacts + 20);  // from 2^-53 to 10^-50 by a factor R an impact
  const Agreement agreement = agreement_of(in_double, exact, 1e-12 * duration);
  EXPECT_EQ(agreement.until, duration);
  EXPECT_EQ(count(agreement.events, Event::Kind::impact), impacts);
  EXPECT_EQ(count(agreement.events, Event::Kind::rest), 1u);
  const ContactErrors errors = compare(in_double.events, agreement.events, duration / 2);
  EXPECT_EQ(errors.missed + errors.extra + errors.rests_missed, 0u);
  EXPECT_LT(std::max({errors.time, errors.speed, errors.rest}), 1e-13);  // a few roundings of times up to 12.6
}

TEST(Agreement, leaves_out_the_turns_between_those_impacts_too) {
  point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5);
  scene.friction = {0.1, 0.2};
  const double duration = 8 * std::numbers::pi;
  const RunRecord in_double = record_of(scene, duration), exact = reference_of(scene, duration);
  ASSERT_GT(count(in_double.events, Event::Kind::chatter), 0u);
  ASSERT_GT(count(exact.events, Event::Kind::reversal), count(in_double.events, Event::Kind::reversal) + 20);
  const Agreement agreement = agreement_of(in_double, exact, 1e-12 * duration);
  EXPECT_EQ(agreement.until, duration);
  EXPECT_EQ(agreement.events.size(), with_rests_joined(in_double.events).size());
}

TEST(Agreement, of_chaotic_motion_ends_and_lasts_the_longer_the_more_room_there_is) {
  // One stop in the middle. Errors grow e-fold in less than two of the 100 periods, so that 1e-15 becomes all.
  point::Problem scene = support::scene_of({0.02, 1.0, 2.7, 0.0}, 0.0, std::numeric_limits<double>::infinity(), 0.8);
  const double period = 2 * std::numbers::pi / 2.7, duration = 100 * period;
  const RunRecord in_double = record_of(scene, duration), exact = reference_of(scene, duration);
  double before = 0.0;
  std::size_t events = 0;
  for (const double tolerance : {1e-12, 1e-9, 1e-6, 1e-3}) {
    const Agreement agreement = agreement_of(in_double, exact, tolerance);
    EXPECT_GT(agreement.until, before + 2 * period) << tolerance;
    EXPECT_GT(agreement.events.size(), events) << tolerance;
    EXPECT_LT(agreement.until, duration - 10 * period) << tolerance;
    EXPECT_LE(agreement.events.back().time, agreement.until) << tolerance;
    before = agreement.until, events = agreement.events.size();
  }
  EXPECT_EQ(agreement_of(exact, exact, 0.0).until, duration);  // with itself without end
}

}  // namespace
}  // namespace clatter::accuracy::agreement_test
