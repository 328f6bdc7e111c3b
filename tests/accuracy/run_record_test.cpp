#include "accuracy/run_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "accuracy/comparison.hpp"
#include "motion/together.hpp"
#include "observables/extremes/extrema_observer.hpp"
#include "observables/harmonics/exact_harmonics.hpp"
#include "point/exact_motion.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/runs.hpp"

namespace clatter::accuracy::run_record_test {
namespace {

constexpr double pi_ = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

point::Problem figure_18() { return support::scene_of({0.1, -1.0, 1.0, 0.0}, -0.5, 0.5, 0.7); }
/// Two chatters and two rests in a period of the force.
point::Problem with_rests() { return support::scene_of({0.1, 1.0, 0.3, 0.0}, -0.2, 0.2, 0.5); }

double period_of(const point::Problem& scene) { return 2 * pi_ / scene.oscillator.frequency; }
RecordObservables three_harmonics(const point::Problem& scene) { return {3, scene.oscillator.frequency}; }

/// A run with observables in double, of a scene that is lightly damped and away from resonance.
RunRecord observed_in_double(const point::Problem& scene, double duration, const RecordObservables& observables) {
  stepping::Exact<double, effect_sets::complete(Damping::light, Forcing::regular)> exact(scene);
  motion::State<double> state = point::ExactMotion::of(scene)->start();
  observables::Extrema::Observer extrema;
  observables::ExactHarmonics harmonics(observables.harmonics, observables.base_frequency);
  motion::Together both(extrema, harmonics);
  RunRecord record;
  record.outcome = run_for(exact, state, duration / exact.period(), both);
  record.x = state.x, record.v = state.v, record.impacts = exact.impacts();
  harmonics.finish(record.x, duration);
  record.harmonics = harmonics.displacement(), record.v_harmonics = harmonics.velocity();
  record.x_range = extrema.displacement(outermost(rigid_ones(scene.stops))), record.v_range = extrema.velocity();
  return record;
}

std::size_t count(const RunRecord& record, Event::Kind kind) {
  return static_cast<std::size_t>(std::ranges::count(record.events, kind, &Event::kind));
}

/// A scene that starts on its steady motion, in double, or near it.
point::Problem on_steady_motion(point::Problem scene, double dx = 0, double dv = 0) {
  const support::Steady steady = support::steady_of(scene);
  EXPECT_EQ(steady.status, steady::Status::periodic);
  EXPECT_EQ(steady.turns, 1.0);
  scene.start.displacement = steady.from.x + dx, scene.start.velocity = steady.from.v + dv;
  return scene;
}

/// Largest difference of extrema and harmonics, each over the largest of its kind.
double observables_off(const RunRecord& record, const RunRecord& reference) {
  double off = 0;
  const auto ranges = [&](const observables::Range& a, const observables::Range& b) {
    const double size = std::max(std::abs(b.low), std::abs(b.high));
    off = std::max({off, std::abs(a.low - b.low) / size, std::abs(a.high - b.high) / size});
  };
  const auto harmonics = [&](const auto& a, const auto& b) {
    ASSERT_EQ(a.size(), b.size());
    double size = 0;
    for (const auto& amplitude : b) size = std::max(size, std::abs(amplitude));
    for (std::size_t k = 0; k < a.size(); ++k) off = std::max(off, std::abs(a[k] - b[k]) / size);
  };
  ranges(record.x_range, reference.x_range), ranges(record.v_range, reference.v_range);
  harmonics(record.harmonics, reference.harmonics), harmonics(record.v_harmonics, reference.v_harmonics);
  return off;
}

TEST(RunRecord, observables_in_double_are_those_of_fifty_digits) {
  for (const point::Problem& scene :
       {figure_18(), with_rests(), support::scene_of({0.05, 1.0, 6.0, 0.1}, -0.05, 0.05, 0.9)}) {
    const double duration = 5 * period_of(scene);
    const auto observables = three_harmonics(scene);
    const RunRecord record = observed_in_double(scene, duration, observables);
    const RunRecord reference = reference_of(scene, duration, observables);
    ASSERT_EQ(record.outcome, stepping::Outcome::completed);
    ASSERT_EQ(record.harmonics.size(), 4u);
    // tens of arcs, each with a rounding or two of its start, and contracting motion
    EXPECT_LT(observables_off(record, reference), 3e-14) << "nu = " << scene.oscillator.frequency;
  }
}

TEST(RunRecord, without_stops_is_the_linear_steady_state) {
  const double h = 0.1, f = 1.3, nu = 1.5, load = 0.25, phase = 0.4;
  point::Problem scene = support::scene_of({h, f, nu, load}, -infinity, infinity, 1.0);
  const double amplitude = f / std::hypot(1 - nu * nu, 2 * h * nu), lag = std::atan2(2 * h * nu, 1 - nu * nu);
  scene.start = {load + amplitude * std::sin(phase - lag), nu * amplitude * std::cos(phase - lag), phase};
  for (const bool in_double : {true, false}) {
    const double duration = 3 * period_of(scene);
    const RunRecord record = in_double ? observed_in_double(scene, duration, three_harmonics(scene))
                                       : reference_of(scene, duration, three_harmonics(scene));
    EXPECT_TRUE(record.events.empty());
    EXPECT_EQ(record.impacts, 0.0);
    const double tolerance = 4e-15 * (amplitude + load);  // the start and the closed form: some roundings each
    EXPECT_NEAR(record.x_range.low, load - amplitude, tolerance);
    EXPECT_NEAR(record.x_range.high, load + amplitude, tolerance);
    EXPECT_NEAR(record.v_range.low, -nu * amplitude, nu * tolerance);
    EXPECT_NEAR(record.v_range.high, nu * amplitude, nu * tolerance);
    EXPECT_NEAR(record.x, scene.start.displacement, tolerance);
    EXPECT_NEAR(record.v, scene.start.velocity, nu * tolerance);
    // x = load + A sin(nu tau + phase - lag): e^(i nu tau) has the factor A/2 at a quarter of a turn less
    const std::complex<double> first = std::polar(amplitude / 2, phase - lag - pi_ / 2);
    const std::complex<double> expected[] = {load, first, 0, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto of_v = k == 1 ? std::complex<double>(0, nu) * first : 0;
      EXPECT_LT(std::abs(record.harmonics[k] - expected[k]), tolerance) << k;
      EXPECT_LT(std::abs(record.v_harmonics[k] - of_v), nu * tolerance) << k;
    }
  }
}

TEST(RunRecord, observes_only_the_observables_asked_for) {
  const RunRecord record = reference_of(figure_18(), 10);
  EXPECT_TRUE(record.harmonics.empty() && record.v_harmonics.empty());
  const RunRecord observed = reference_of(figure_18(), 10, RecordObservables{.harmonics = 2});
  EXPECT_EQ(observed.harmonics.size(), 3u);
  EXPECT_EQ(record.events.size(), observed.events.size());
  EXPECT_EQ(record.x, observed.x);  // observing changes nothing
  EXPECT_EQ(static_cast<double>(count(record, Event::Kind::impact)), record.impacts);
}

TEST(RunRecord, over_the_budget_of_impacts_says_so) {
  point::Problem scene = figure_18();
  scene.time.max_impacts = 3;
  EXPECT_EQ(record_of(scene, 20).outcome, stepping::Outcome::event_budget);
  EXPECT_EQ(reference_of(scene, 20).outcome, stepping::Outcome::event_budget);
}

TEST(RestsJoined, are_one_for_each_stay) {
  const auto rest = [](double time, double length) { return Event{Event::Kind::rest, Side::upper, time, 0, length}; };
  const Event impact{Event::Kind::impact, Side::upper, 4, 1, 0};
  const auto joined = with_rests_joined({rest(1, 1), rest(2, 0.5), rest(2.5, 0.25), impact, rest(4, 1)});
  ASSERT_EQ(joined.size(), 3u);
  EXPECT_EQ(joined[0].time, 1.0);
  EXPECT_EQ(joined[0].end(), 2.75);
  EXPECT_EQ(joined[2].length, 1.0);
  EXPECT_TRUE(with_rests_joined({}).empty());
  const auto stick = [](double time, double length) { return Event{Event::Kind::stick, Side::none, time, 0, length}; };
  const Event reversal{Event::Kind::reversal, Side::none, 5};
  EXPECT_EQ(with_rests_joined({stick(1, 1), stick(2, 1), stick(3.5, 1), reversal, reversal}).size(), 4u);
  Event of_loose = stick(2, 1);  // cut by the section that cuts that of the main mass
  of_loose.of_wall = true;
  EXPECT_EQ(with_rests_joined({of_loose, stick(2.5, 0.5), stick(3, 1), of_loose}).size(), 3u);
  point::Problem scene = with_rests();
  scene.start.phase = 2;  // the section at 1 period lies in a rest
  const RunRecord record = record_of(scene, 2 * period_of(scene));
  EXPECT_EQ(with_rests_joined(record.events).size() + 1, record.events.size());
}

TEST(PeriodicReference, is_the_same_from_starts_beside_the_motion) {
  const point::Problem scene = figure_18();
  std::vector<RunRecord> found;
  for (const auto& [dx, dv] : {std::pair{0.0, 0.0}, {1e-3, 0.0}, {0.0, -1e-3}, {-1e-3, 1e-3}}) {
    const auto record = periodic_reference(on_steady_motion(scene, dx, dv), 1, three_harmonics(scene));
    ASSERT_TRUE(record) << dx << ' ' << dv;
    found.push_back(*record);
  }
  for (const RunRecord& record : found) {  // converged to 30 digits: the same doubles
    ASSERT_EQ(record.events.size(), 2u);
    EXPECT_EQ(record.x, found[0].x);
    EXPECT_EQ(record.v, found[0].v);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(record.events[i].time, found[0].events[i].time);
    EXPECT_EQ(record.duration, period_of(scene));
    // its harmonics are taken from arcs that each start on a rounded state
    EXPECT_LT(observables_off(record, found[0]), 1e-14);
  }
}

TEST(PeriodicReference, has_the_impacts_and_rests_of_the_steady_motion_in_double) {
  point::Problem resting = with_rests(), resting_at_section = with_rests();
  resting.start.phase = 1, resting_at_section.start.phase = 2;
  for (const auto& [scene, rests] : {std::pair{figure_18(), 0u}, {resting, 2u}, {resting_at_section, 3u}}) {
    const support::Steady steady = support::steady_of(scene);
    const auto reference = periodic_reference(on_steady_motion(scene), 1, three_harmonics(scene));
    ASSERT_TRUE(reference);
    EXPECT_EQ(count(*reference, Event::Kind::rest), rests) << "a section that lies in one cuts it in two";
    std::vector<Event> events;
    events = steady.record.impacts;
    events.insert(events.end(), steady.record.rests.begin(), steady.record.rests.end());
    std::ranges::stable_sort(events, {}, &Event::time);
    const ContactErrors errors = compare(events, reference->events, reference->duration / 2);
    EXPECT_EQ(errors.missed + errors.extra + errors.rests_missed, 0u);
    // settled to 1e-12 of the state, and by Newton's method to far less: roundings of times up to a period
    EXPECT_LT(std::max({errors.time, errors.rest}), 1e-14 * std::max(1.0, reference->duration / (2 * pi_)));
    EXPECT_LT(errors.speed, 1e-13);  // the motion is settled to 1e-12 of its state
  }
}

TEST(PeriodicReference, of_more_periods_repeats_the_motion) {
  const point::Problem scene = figure_18();
  const auto one = periodic_reference(on_steady_motion(scene), 1, three_harmonics(scene));
  const auto three = periodic_reference(on_steady_motion(scene), 3, three_harmonics(scene));
  ASSERT_TRUE(one && three);
  ASSERT_EQ(three->events.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(three->events[i].time, one->events[i % 2].time + static_cast<double>(i / 2) * 2 * pi_, 1e-14);
  EXPECT_LT(observables_off(*three, *one), 1e-14);
}

TEST(PeriodicReference, is_nothing_if_the_motion_does_not_repeat) {
  const point::Problem chaotic = support::scene_of({0.1, -1.0, 0.95, 0.0}, -3, 3, 0.7);
  for (const double periods : {3.0, 4.0, 7.0})
    EXPECT_FALSE(periodic_reference(chaotic, periods, three_harmonics(chaotic))) << periods;
  const point::Problem resonant = support::scene_of({0.0, 1.0, 1.0, 0.0}, -infinity, infinity, 1.0);
  EXPECT_FALSE(periodic_reference(resonant, 1, three_harmonics(resonant)));
  point::Problem dataset = figure_18();  // over half a period its displacement changes its sign
  EXPECT_FALSE(periodic_reference(on_steady_motion(dataset), 0.5, three_harmonics(dataset)));
  dataset.time.max_impacts = 1;
  EXPECT_FALSE(periodic_reference(dataset, 1, three_harmonics(dataset)));
}

}  // namespace
}  // namespace clatter::accuracy::run_record_test
