// Random scenes with dry friction by Dormand and Prince's method, which shares the phases of the exact one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hard/any_sliding_scene.hpp"
#include "stepping/dormand_prince.hpp"
#include "support/methods.hpp"

namespace clatter::hard::sliding_methods_test {
namespace {

using accuracy::Event;
using accuracy::RunRecord;

RunRecord run_of(AnyScene any, double tolerance) {
  any.scene.integration.tolerance = tolerance;
  return support::record_by<stepping::DormandPrince>(any.scene, any.duration);
}

std::ptrdiff_t count(const RunRecord& record, Event::Kind kind) {
  return std::ranges::count(accuracy::with_rests_joined(record.events), kind, &Event::kind);
}

/// Impacts aren't counted: those of a chatter that is lower than the tolerance are left out.
bool has_same_events(const RunRecord& a, const RunRecord& b) {
  const auto same = [&](Event::Kind kind) { return count(a, kind) == count(b, kind); };
  return a.outcome == b.outcome && same(Event::Kind::stick) && same(Event::Kind::rest);
}

TEST(SlidingScenes, stick_and_rest_by_dopri5_as_they_do_exactly) {
  Tally same("sticks and rests by dopri5", sliding), ends("state at the end by dopri5", sliding);
  in_every_scene(sliding, [&](const AnyScene& any) {
    const RunRecord exact = accuracy::record_of(any.scene, any.duration), fine = run_of(any, 1e-12);
    same.take(any, has_same_events(fine, exact) ? 0 : std::numeric_limits<double>::infinity());
    if (exact.outcome != stepping::Outcome::completed) return;
    const double off = std::abs(fine.x - exact.x), coarse = std::abs(run_of(any, 1e-10).x - exact.x);
    // some thousand steps err by the tolerance each; motion that multiplies this does so with both tolerances
    ends.take(any, off / std::max({1e-8 * std::abs(exact.x), 1e-11, coarse / 10}));
  });
  same.conclude(1), ends.conclude(0.9);
}

}  // namespace
}  // namespace clatter::hard::sliding_methods_test
