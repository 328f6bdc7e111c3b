#include "accuracy/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random.hpp"

namespace clatter::accuracy::comparison_test {
namespace {

using Events = std::vector<Event>;

Event impact(double time, double speed = 1.0, Side side = Side::upper) {
  return {Event::Kind::impact, side, time, speed, 0.0};
}
Event chatter(double time, double length) { return {Event::Kind::chatter, Side::upper, time, 0.0, length}; }
Event rest(double time, double length, Side side = Side::upper) { return {Event::Kind::rest, side, time, 0.0, length}; }

Events impacts(std::initializer_list<double> times) {
  Events events;
  for (const double time : times) events.push_back(impact(time));
  return events;
}
Events later(Events events, double lag) {
  for (Event& event : events) event.time += lag;
  return events;
}
Events together(Events events, const Events& more) {
  events.insert(events.end(), more.begin(), more.end());
  std::ranges::stable_sort(events, {}, &Event::time);
  return events;
}

/// Impacts after flights that become half as long each time: at 1, 1.5, 1.75, ... up to 2.
Events bounces(int count) {
  Events events;
  for (int i = 0; i < count; ++i) events.push_back(impact(2 - std::ldexp(1.0, -i)));
  return events;
}
/// So many bounces, and a completed chatter for the others.
Events completed_bounces(int count) {
  const double left = std::ldexp(1.0, 1 - count);
  return together(bounces(count), {chatter(2 - left, left)});
}

constexpr double any = 1e9;  ///< no bound on the lag

void expect_counts(const ContactErrors& errors, std::size_t missed, std::size_t extra) {
  EXPECT_EQ(errors.missed, missed);
  EXPECT_EQ(errors.extra, extra);
}

TEST(Comparison, finds_missed_and_doubled_impacts) {
  const Events reference = impacts({1, 2, 3, 4});
  const Events run{impact(1.01), impact(2.99), impact(3.4), impact(4.01, 0.9)};
  const ContactErrors errors = compare(run, reference, any);
  expect_counts(errors, 1, 1);
  EXPECT_NEAR(errors.time, 0.01, 1e-12);
  EXPECT_NEAR(errors.speed, 0.1, 1e-12);
}

TEST(Comparison, of_a_run_with_itself_finds_nothing) {
  const Events events = together(completed_bounces(12), {rest(2, 0.5), impact(3, 2.0, Side::lower)});
  const ContactErrors errors = compare(events, events, any);
  expect_counts(errors, 0, 0);
  EXPECT_EQ(errors.rests_missed, 0u);
  for (const double error : {errors.time, errors.speed, errors.rest}) EXPECT_EQ(error, 0.0);
}

TEST(Comparison, any_single_impact_left_out_is_missed_and_any_put_in_is_doubled) {
  const Events reference = together(bounces(8), impacts({3, 3.5, 5}));
  for (std::size_t i = 0; i < reference.size(); ++i) {
    SCOPED_TRACE(i);
    Events run = reference;
    run.erase(run.begin() + static_cast<std::ptrdiff_t>(i));
    expect_counts(compare(run, reference, any), 1, 0);
    expect_counts(compare(reference, run, any), 0, 1);
    for (const auto& [one, other] : {std::pair{run, reference}, {reference, run}})
      EXPECT_EQ(compare(one, other, any).time, 0.0) << "its neighbours are not mistaken for it";
  }
}

TEST(Comparison, pairs_impacts_that_are_off_by_less_than_a_quarter_of_their_distance) {
  // neighbours may be off in opposite directions: two quarters of their distance are the half that separates them
  for (std::uint64_t i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    support::Random random(1, i);
    Events reference;
    double time = 0;
    for (int k = 0; k < 40; ++k) reference.push_back(impact(time += random.logarithmic(1e-4, 1)));
    Events run = reference;
    double worst = 0;
    for (std::size_t k = 0; k < run.size(); ++k) {
      const double before = k > 0 ? reference[k].time - reference[k - 1].time : 1,
                   after = k + 1 < run.size() ? reference[k + 1].time - reference[k].time : 1;
      const double off = 0.24 * std::min(before, after) * random.uniform(-1, 1);
      run[k].time += off, worst = std::max(worst, std::abs(off));
    }
    const ContactErrors errors = compare(run, reference, any);
    expect_counts(errors, 0, 0);
    EXPECT_NEAR(errors.time, worst, 1e-13);  // times of up to 40: a rounding of each
    if (HasFailure()) break;
  }
}

TEST(Comparison, one_impact_that_is_off_does_not_make_the_next_ones_missed) {
  for (const double first : {0.8, 1.2}) {
    const ContactErrors errors = compare(impacts({first, 2, 2.1, 2.2}), impacts({1, 2, 2.1, 2.2}), any);
    expect_counts(errors, 0, 0);
    EXPECT_NEAR(errors.time, 0.2, 1e-15);
  }
}

TEST(Comparison, a_sequence_that_comes_late_as_a_whole_is_late_and_not_missed) {
  const Events reference = bounces(20);
  for (const double lag : {0.2, -0.2, 0.01}) {  // less than half of the first flight, more than all of the last ones
    const ContactErrors errors = compare(later(reference, lag), reference, any);
    expect_counts(errors, 0, 0);
    EXPECT_NEAR(errors.time, std::abs(lag), 1e-15);
  }
}

TEST(Comparison, a_late_sequence_loses_only_the_impacts_that_it_lacks) {
  Events run = later(bounces(20), 0.2);
  run.erase(run.begin() + 5);
  expect_counts(compare(run, bounces(20), any), 1, 0);
  expect_counts(compare(bounces(20), run, any), 0, 1);
}

TEST(Comparison, a_run_may_fall_behind_up_to_the_latest) {
  Events reference, run;
  for (int i = 0; i < 40; ++i) reference.push_back(impact(i)), run.push_back(impact(1.125 * i));  // a drift, exactly
  const ContactErrors unbounded = compare(run, reference, any);
  expect_counts(unbounded, 0, 0);
  EXPECT_EQ(unbounded.time, 0.125 * 39);
  const ContactErrors bounded = compare(run, reference, 2);
  EXPECT_GT(bounded.missed, 0u);
  EXPECT_LE(bounded.time, 2.0);
  EXPECT_EQ(compare(run, reference, 5).missed, 0u);
}

TEST(Comparison, impacts_in_a_chatter_that_the_other_completes_do_not_count) {
  const Events twenty = bounces(20), completed = completed_bounces(10);
  expect_counts(compare(completed, twenty, any), 0, 0);
  expect_counts(compare(twenty, completed, any), 0, 0);
  expect_counts(compare(later(completed, 0.2), twenty, any), 0, 0);  // late as a whole
  expect_counts(compare(bounces(10), twenty, any), 10, 0);
  expect_counts(compare(together(bounces(10), {{Event::Kind::chatter, Side::lower, 1.998, 0, 0.002}}), twenty, any), 10,
                0);
  expect_counts(compare(together(bounces(10), {chatter(1.9, 0.01)}), twenty, any), 10, 0);  // long before
}

TEST(Comparison, rests_are_matched_where_they_overlap) {
  const Events reference{rest(1, 0.5), impact(2), rest(3, 0.5)};
  const ContactErrors late = compare(Events{rest(1.1, 0.3), impact(2), rest(3.01, 0.5)}, reference, any);
  EXPECT_EQ(late.rests_missed, 0u);
  EXPECT_NEAR(late.rest, 0.1, 1e-15);
  EXPECT_EQ(compare(Events{rest(1, 0.5), impact(2), rest(3.6, 0.5)}, reference, any).rests_missed, 1u);
  EXPECT_EQ(compare(Events{}, reference, any).rests_missed, 2u);
  EXPECT_EQ(compare(Events{rest(1, 2.5, Side::lower)}, reference, any).rests_missed, 2u);
  EXPECT_EQ(compare(Events{chatter(1, 2.5)}, reference, any).rests_missed, 2u);  // a completed chatter is no rest
}

TEST(Comparison, a_rest_that_a_section_cuts_is_one) {
  const ContactErrors errors = compare(Events{rest(1, 0.25), rest(1.25, 0.25)}, Events{rest(1, 0.5)}, any);
  EXPECT_EQ(errors.rests_missed, 0u);
  EXPECT_EQ(errors.rest, 0.0);
}

TEST(Comparison, sticks_are_rests_at_no_stop_and_reversals_are_not_compared) {
  const auto stick = [](double time, double length) {
    return Event{Event::Kind::stick, Side::none, time, 0.0, length};
  };
  const auto reversal = [](double time) { return Event{Event::Kind::reversal, Side::none, time}; };
  const Events reference{stick(1, 0.5), reversal(2), stick(3, 0.5), rest(4, 0.5)};
  const ContactErrors off = compare(Events{stick(1, 0.5), stick(3, 0.4), rest(4.02, 0.5)}, reference, any);
  EXPECT_EQ(off.rests_paired, 3u);
  EXPECT_NEAR(off.rest, 0.1, 1e-15);
  EXPECT_EQ(off.missed + off.extra + off.rests_missed, 0u);
  EXPECT_EQ(compare(Events{rest(1, 3.5)}, reference, any).rests_missed, 2u);
  EXPECT_EQ(compare(Events{stick(1, 3.5)}, reference, any).rests_missed, 1u);
}

TEST(Comparison, takes_the_stops_apart) {
  Events lower;
  for (const double time : {1.02, 2.02, 3.02}) lower.push_back(impact(time, 0.5, Side::lower));
  const Events upper = impacts({1, 2, 3}), both = together(upper, lower);
  expect_counts(compare(both, both, any), 0, 0);
  expect_counts(compare(upper, both, any), 3, 0);
  expect_counts(compare(both, upper, any), 0, 3);
  const ContactErrors errors = compare(together(later(upper, 0.3), later(lower, -0.1)), both, any);  // past each other
  expect_counts(errors, 0, 0);
  EXPECT_NEAR(errors.time, 0.3, 1e-15);
  Events faster = both;
  for (Event& event : faster)
    if (event.side == Side::lower) event.before = 0.6;
  EXPECT_NEAR(compare(faster, both, any).speed, 0.1, 1e-15);  // over the largest speed on either stop
}

TEST(Comparison, with_nothing_finds_every_impact_missed) {
  expect_counts(compare(Events{}, Events{}, any), 0, 0);
  expect_counts(compare(Events{}, bounces(5), any), 5, 0);
  expect_counts(compare(bounces(5), Events{}, any), 0, 5);
}

}  // namespace
}  // namespace clatter::accuracy::comparison_test
