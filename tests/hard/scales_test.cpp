// Lengths, forces and frequencies many orders apart.

#include <gtest/gtest.h>

#include <cmath>

#include "hard/measure.hpp"

namespace clatter::hard::scales_test {
namespace {

TEST(Scales, agrees_with_fifty_digits) {
  for (const Case& one : cases_of("scales"))  // xs = 1e-9: as for close stops
    expect_agreement(one,
                     epsilon<double>() * (one.what == "xs = 1e-9" ? 4 * pi<double>() / std::cbrt(12e-9 / 0.5) : 1.0));
}

TEST(Scales, a_vanishing_force_is_no_force) {
  const Case &none = case_of("scales", "f = 0"), &tiny = case_of("scales", "f = 1e-300");
  const accuracy::RunRecord without = accuracy::record_of(none.scene, none.duration),
                            with = accuracy::record_of(tiny.scene, tiny.duration);
  const support::Deviation d = support::deviation(with, without);
  EXPECT_TRUE(d.same_events) << d.difference;
  EXPECT_GT(d.impacts, 0u);
  EXPECT_LT(d.largest(), 1e-13);  // so small a force only selects other formulas, which round differently
}

}  // namespace
}  // namespace clatter::hard::scales_test
