// A run that ends within a chatter ends in a flight: not on the stop, and with the speed of that flight.

#include <gtest/gtest.h>

#include "hard/measure.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::hard::chatter_cut_by_end_test {
namespace {

TEST(ChatterCutByEnd, agrees_with_fifty_digits) { expect_agreement("chatter_cut_by_end"); }

TEST(ChatterCutByEnd, ends_in_flight_however_near_the_end_of_the_chatter_is) {
  for (const char* what : {"in its first flight", "1e-3 before its end", "1e-9 before its end"}) {
    const Case& one = case_of("chatter_cut_by_end", what);
    const accuracy::RunRecord record = accuracy::record_of(one.scene, one.duration);
    for (const accuracy::Event& event : record.events) EXPECT_NE(event.kind, accuracy::Event::Kind::rest) << what;
    EXPECT_NE(record.v, 0.0) << what;
    EXPECT_LE(record.x, one.scene.stops.upper) << what;
  }
}

TEST(ChatterCutByEnd, leaves_the_motion_after_it_as_it_is) {
  // stroboscopic sections cut the run anywhere: here 1e-4 ... 1e-13 before the end of the chatter
  const Case& whole = case_of("chatter_and_rest", "R = 0.5");
  const accuracy::Event expected = accuracy::record_of(whole.scene, 9.0).events.back();
  const double chatter_end = 4.4158803670592697, period = 2 * pi<double>() / whole.scene.oscillator.frequency;
  for (double before : {1e-4, 1e-7, 1e-10, 1e-13}) {
    point::Problem scene = whole.scene;
    const auto cut = [&]<Effects effects>() {
      stepping::Exact<double, effects> integrator(scene, limits_of(scene));
      motion::State<double> state;
      stepping::NoObserver nobody;
      EXPECT_EQ(integrator.advance(state, (chatter_end - before) / period, 0, nobody), stepping::Outcome::completed);
      EXPECT_EQ(integrator.advance(state, (expected.time + 1e-3) / period, 0, nobody), stepping::Outcome::completed);
      return state;
    };
    const motion::State<double> state = cut.operator()<effect_sets::complete(Damping::light, Forcing::regular)>();
    const accuracy::RunRecord uncut = accuracy::record_of(scene, expected.time + 1e-3);
    EXPECT_NEAR(state.x, uncut.x, 1e-14) << before;
    EXPECT_NEAR(state.v, uncut.v, 1e-14) << before;
  }
}

}  // namespace
}  // namespace clatter::hard::chatter_cut_by_end_test
