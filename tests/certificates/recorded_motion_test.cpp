#include "certificates/recorded_motion.hpp"

#include <gtest/gtest.h>

namespace clatter::certificates::recorded_motion_test {
namespace {

using Kind = motion::Event::Kind;

const Stops stops{};  // rigid ones

point::MotionRecorder recorder_of(const std::vector<motion::Event>& events) {
  point::MotionRecorder recorder{Stops{}};
  recorder.events = events;
  return recorder;
}

std::vector<RecordedEvent<2>> events_of(const point::MotionRecorder& recorder, const Stops& of) {
  Growth<2> growth;
  return joined_events(recorder, of, growth);
}

TEST(Events, sections_dont_divide_a_rest_or_a_chatter) {
  const auto events = events_of(recorder_of({{Kind::impact, Side::lower, 1.0, -0.1},
                                             {Kind::chatter, Side::lower, 1.0, 0.0, 0.25},
                                             {Kind::chatter, Side::lower, 1.25, 0.0, 0.25},
                                             {Kind::rest, Side::lower, 1.5, 0.0, 0.5},
                                             {Kind::rest, Side::lower, 2.0, 0.0, 1.0}}),
                                stops);
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[1].kind, Kind::chatter);
  EXPECT_EQ(events[1].time, 1.0);
  EXPECT_EQ(events[1].end(), 1.5);
  EXPECT_EQ(events[2].kind, Kind::rest);
  EXPECT_EQ(events[2].time, 1.5);
  EXPECT_EQ(events[2].end(), 3.0);
}

TEST(Events, a_force_within_rounding_of0_belongs_to_the_rest) {
  const auto events = events_of(recorder_of({{Kind::rest, Side::upper, 0.0, 0.0, 0.5},
                                             {Kind::chatter, Side::upper, 0.5, 0.0, 0.125},
                                             {Kind::rest, Side::upper, 0.625, 0.0, 0.375},
                                             {Kind::impact, Side::lower, 2.0, -1.0}}),
                                stops);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, Kind::rest);
  EXPECT_EQ(events[0].end(), 1.0);
}

TEST(Events, rests_with_a_flight_between_them_stay_two) {
  const auto events = events_of(recorder_of({{Kind::rest, Side::upper, 0.0, 0.0, 0.5},
                                             {Kind::impact, Side::upper, 1.0, 0.5},
                                             {Kind::rest, Side::upper, 1.0, 0.0, 0.5}}),
                                stops);
  EXPECT_EQ(events.size(), 3U);
}

TEST(Events, without_force_at_a_soft_stop_there_is_none) {
  const Stops soft{.upper = 0.5, .stiffness_upper = 30};
  EXPECT_TRUE(events_of(recorder_of({{Kind::chatter, Side::upper, 0.0, 0.0, 1e-8}}), soft).empty());
}

}  // namespace
}  // namespace clatter::certificates::recorded_motion_test
