// The tangent map against differences of neighbouring motions, made in 50 digits without any derivative.

#include "motion/tangent_map.hpp"

#include <gtest/gtest.h>

#include "hard/tally.hpp"
#include "math/fifty_digits.hpp"
#include "point/reference_motion.hpp"

namespace clatter::hard::tangent_test {
namespace {

/// Whether a motion has a derivative with respect to its start, and few enough impacts to be run in 50 digits.
struct Smooth : Watcher {
  void rest(const motion::Event&) { smooth = false; }
  void impact(const motion::Event& impact) {
    smooth = smooth && impact.before * sign_of(impact.side) > 0 && impact.after != 0;
    ++impacts;
  }
  std::uint64_t impacts = 0;
  bool smooth = true;
};

bool suits(const AnyScene& any) {
  Smooth seen;
  return watch(any, seen) == stepping::Outcome::completed && seen.smooth && seen.impacts > 0 && seen.impacts <= 20;
}

/// The final state of a scene in 50 digits from a start moved by (dx, dv).
motion::State<FiftyDigits> end_of(const AnyScene& any, const FiftyDigits& dx, const FiftyDigits& dv,
                                  point::ReferenceRecorder& recorder) {
  const auto motion = point::ReferenceMotion::of(any.scene);
  motion::State<FiftyDigits> state = motion->start();
  state.x += dx, state.v += dv;
  EXPECT_EQ(motion->run_for(state, FiftyDigits(any.duration / motion->period()), recorder),
            stepping::Outcome::completed);
  return state;
}

/// The largest difference of the tangent map's entries from those of neighbouring motions, in units of the allowed one.
double deviation_of_tangent(const AnyScene& any) {
  const Stops& stops = any.scene.stops;
  const double x = any.scene.start.displacement;
  const FiftyDigits step(x - stops.lower > stops.upper - x ? "-1e-20" : "1e-20");  // away from the stop it may start on
  point::ReferenceRecorder differentiating, none;
  differentiating.tangent.emplace(any.scene.stops);
  const auto end = end_of(any, 0, 0, differentiating);
  const auto by_x = end_of(any, step, 0, none), by_v = end_of(any, 0, step, none);
  const motion::Jacobian<FiftyDigits> map = differentiating.tangent->map(),
                                      expected{(by_x.x - end.x) / step, (by_v.x - end.x) / step,
                                               (by_x.v - end.v) / step, (by_v.v - end.v) / step};
  FiftyDigits difference = 0, largest = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    difference = std::max(difference, FiftyDigits(abs(map[i] - expected[i])));
    largest = std::max(largest, FiftyDigits(abs(expected[i])));
  }
  // observers are given times and velocities as doubles, whose rounding is multiplied by the shear of a soft impact; if
  // the motion has faded, the step is only in the last of fifty digits
  const FiftyDigits allowed = FiftyDigits("1e-11") * largest + FiftyDigits("1e-50") / abs(step) * 100;
  return static_cast<double>(FiftyDigits(difference / allowed));
}

TEST(Properties, tangent_map_is_the_derivative_of_the_motion) {
  constexpr int enough = 300;
  Tally tally("tangent map against neighbouring motions");
  int found = 0;
  in_every_scene([&](const AnyScene& any) {
    if (found == enough || !suits(any)) return;
    ++found;
    tally.take(any, deviation_of_tangent(any));
  });
  tally.conclude(0);
  if (tested_scenes().to - tested_scenes().from >= Tally::enough) {
    EXPECT_EQ(found, enough);
  }
}

}  // namespace
}  // namespace clatter::hard::tangent_test
