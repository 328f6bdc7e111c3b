// Errors that could add up over long runs: the speed of conservative impacts, and the phase of the force.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "hard/measure.hpp"
#include "steady/find_steady.hpp"

namespace clatter::hard::long_test {
namespace {

/// Records the extreme speeds at contacts and the time of the last one.
struct Drift {
  double slowest = INFINITY, fastest = 0.0, last = 0.0, count = 0.0;

  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event& event) {
    if (event.kind != motion::Event::Kind::impact) return;
    slowest = std::min(slowest, event.speed()), fastest = std::max(fastest, event.speed());
    last = event.time, ++count;
  }
};

/// A million impacts, or the number in the environment variable CLATTER_IMPACTS.
double impacts_to_take() {
  const char* const text = std::getenv("CLATTER_IMPACTS");
  return text == nullptr ? 1e6 : std::stod(text);
}

TEST(Long, conservative_impacts_neither_gain_nor_lose_speed) {
  Case one = case_of("long", "conservative impacts");
  const double count = impacts_to_take(), between = 2 * std::asin(0.5);
  one.scene.time.max_impacts = 2 * count;
  stepping::Exact<double, effect_sets::complete(Damping::none, Forcing::none)> integrator(one.scene,
                                                                                          limits_of(one.scene));
  motion::State<double> state{0.0, one.scene.start.velocity};
  Drift drift;
  ASSERT_EQ(run_for(integrator, state, count * between / integrator.period(), drift), stepping::Outcome::completed);
  EXPECT_EQ(drift.count, count);
  const double speed = std::sqrt(1.5 * 1.5 - 0.75 * 0.75), off = std::max(drift.fastest - speed, speed - drift.slowest);
  std::cout << count << " impacts, speed off by " << off / speed << ", last time by "
            << drift.last / ((count - 0.5) * between) - 1 << '\n';
  EXPECT_LE(off / speed, 1e-10 * count / 1e8);  // a rounding an impact, were they all of one sign
  EXPECT_NEAR(drift.last / ((count - 0.5) * between), 1.0, 1e-10 * count / 1e8);
  Measured m;
  m.record.outcome = stepping::Outcome::completed, m.record.impacts = drift.count,
  m.record.evaluations = integrator.evaluations();
  m.error = off / speed;
  report(one, m);
}

TEST(Long, ten_million_forcing_periods_keep_the_phase) {
  // on the linear steady state each section has the state of the first one; a phase off by 1e-15 would show
  const Case& one = case_of("long", "1e7 forcing periods");
  stepping::Exact<double, effect_sets::complete(Damping::light, Forcing::regular)> integrator(one.scene,
                                                                                              limits_of(one.scene));
  motion::State<double> state{one.scene.start.displacement, one.scene.start.velocity};
  stepping::NoObserver nobody;
  ASSERT_EQ(run_for(integrator, state, 1e7, nobody), stepping::Outcome::completed);
  EXPECT_EQ(state.periods, 10'000'000);
  EXPECT_EQ(state.phase_turns, 0.0);
  Measured m;
  m.record.outcome = stepping::Outcome::completed, m.record.evaluations = integrator.evaluations();
  m.error = std::max(std::abs(state.x - one.scene.start.displacement), std::abs(state.v - one.scene.start.velocity));
  EXPECT_LE(m.error, 1e-15);
  report(one, m);
}

}  // namespace
}  // namespace clatter::hard::long_test
