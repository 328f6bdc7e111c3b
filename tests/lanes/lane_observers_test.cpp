// The results of observers in lanes against those of the observers in the scalar loop.

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <limits>
#include <optional>

#include "lanes/lane_run.hpp"
#include "observables/contacts/impacts_observer.hpp"
#include "observables/extremes/extrema_observer.hpp"
#include "support/deviation.hpp"
#include "support/random.hpp"

namespace clatter::lanes::lane_observers_test {
namespace {

/// Unequal stops under a load, away from grazes of its own.
point::Problem watched_scene(std::uint64_t index) {
  support::Random random(161, index);
  point::Problem scene = support::scene_of(
      {random.uniform(0.02, 0.4), random.logarithmic(0.5, 3), random.logarithmic(0.3, 4), random.uniform(-0.3, 0.3)},
      -random.logarithmic(0.2, 3), random.logarithmic(0.2, 3), random.uniform(0.2, 0.9));
  scene.start = {random.uniform(-0.2, 0.2), random.uniform(-1, 1), random.uniform(0, 6)};
  return scene;
}

/// Extrema and impacts up to a number of forcing periods.
struct Seen {
  observables::Range x, v;
  std::array<observables::Impacts::OfStop, 2> stops;
};

/// Two observers of one run.
struct Both {
  observables::Extrema::Observer extrema;
  observables::Impacts::Observer impacts;

  template <class A>
  void arc(const A& arc, double begin, double length) {
    extrema.arc(arc, begin, length), impacts.arc(arc, begin, length);
  }
  void event(const motion::Event& event) {
    extrema.event(event);
    if (event.kind == motion::Event::Kind::impact) impacts.event(event);
  }
};

template <Effects E>
Seen seen_by_scalar(const point::Problem& scene, double turns) {
  Both both;
  LaneExact<E> exact(scene);
  motion::State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  EXPECT_EQ(run_for(exact, state, turns, both), stepping::Outcome::completed);
  return {both.extrema.displacement(scene.stops), both.extrema.velocity(), both.impacts.stops()};
}

/// The same from a lane, which stops in the middle of a flight, after so many sections; nothing if it needs the scalar
/// loop, or never stops so.
template <Effects E>
std::optional<Seen> seen_by_lane(const point::Problem& scene, StepFunction step, int sections, double& turns) {
  BlockState lanes{};
  observables::Observe observe;
  observe.extrema = observe.impacts = true;
  for (std::size_t i = 0; i < LaneArray::width; ++i) clear_lane(lanes, i);
  LaneView lane(lanes, 3, scene);
  lane.load(LaneView::Constants<E>(scene.oscillator), scene.stops), lane.begin_observing(observe),
      lane.expect_section(false, false, 1);
  for (int passed = 0, calls = 0;;) {
    if (++calls > 200) return std::nullopt;  // every call ends on a stop
    lanes.arrived = lanes.to_scalar = 0;
    step(lanes);
    if (lanes.to_scalar != 0) return std::nullopt;
    passed += lanes.arrived != 0;
    const LaneState position = lane.state();
    if (passed < sections || position.x == scene.stops.lower || position.x == scene.stops.upper) continue;
    turns = passed + position.phase_turns;
    break;
  }
  return Seen{lane.x_range(), lane.v_range(), lane.stops()};
}

/// The largest difference of two runs' extrema and first impacts; infinite if they count different impacts.
double difference(const Seen& a, const Seen& b) {
  double most = std::max({std::abs(a.x.low - b.x.low), std::abs(a.x.high - b.x.high), std::abs(a.v.low - b.v.low),
                          std::abs(a.v.high - b.v.high)});
  for (const std::size_t i : {0U, 1U}) {
    if (a.stops[i].count != b.stops[i].count) return std::numeric_limits<double>::infinity();
    if (a.stops[i].count > 0)
      most =
          std::max({most, std::abs(a.stops[i].before - b.stops[i].before),
                    std::abs(a.stops[i].after - b.stops[i].after), std::abs(a.stops[i].fastest - b.stops[i].fastest)});
  }
  return most;
}

/// Allows 1e-14 of the motion, some ten roundings an impact, and 32 times the effect of an ulp of the inputs.
template <Effects E>
void expect_same(const Seen& lane, const Seen& scalar, const point::Problem& scene, double turns) {
  const double off = difference(lane, scalar);
  const double size = std::max({-scalar.x.low, scalar.x.high, -scalar.v.low, scalar.v.high});
  if (off <= 1e-14 * size) return;
  double own = 0;
  for (const unsigned signs : move_signs)
    own = std::max(own, difference(seen_by_scalar<E>(moved(scene, signs), turns), scalar));
  EXPECT_LE(off, 1e-14 * size + 32 * own) << support::configuration_of(scene, 0);
}

class LaneWatch : public testing::TestWithParam<InstructionSet> {};

/// Compares what lanes and scalar observers see of 2000 scenes.
template <Effects E, class Change>
void expect_same_seen(InstructionSet arch, const Change& change) {
  std::size_t seen = 0, free = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    point::Problem scene = watched_scene(i);
    change(scene, i);
    double turns = 0;
    const auto lane = seen_by_lane<E>(scene, step_functions_of<E>(arch).observed, 2, turns);
    if (!lane) continue;
    const Seen scalar = seen_by_scalar<E>(scene, turns);
    expect_same<E>(*lane, scalar, scene, turns);
    ++seen, free += scalar.stops[0].count + scalar.stops[1].count == 0;
  }
  std::cout << seen << " of 2000 seen to the end, " << free << " without an impact\n";
  EXPECT_GT(seen, 500u);  // the others chatter or rest, or end each call on a stop
}

TEST_P(LaneWatch, sees_the_extrema_and_impacts_that_the_scalar_observers_see) {
  if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  expect_same_seen<sprung>(GetParam(), [](point::Problem&, std::uint64_t) {});
}

TEST_P(LaneWatch, sees_them_without_a_spring_and_with_an_unstable_one) {
  if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  expect_same_seen<unsprung>(GetParam(), [](point::Problem& scene, std::uint64_t i) {
    scene.oscillator.stiffness = i % 2 == 0 ? 0 : -1;
    scene.oscillator.damping *= std::min(1.0, scene.oscillator.frequency);
  });
}

INSTANTIATE_TEST_SUITE_P(Of, LaneWatch,
                         testing::Values(InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace clatter::lanes::lane_observers_test
