// From rest, h = 0 and nu = 2: x = (2 sin tau - sin 2 tau)/3 reaches 3^(1/2)/2 at tau = 2 pi/3, the stop's position.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hard/measure.hpp"

namespace clatter::hard::graze_from_rest_test {
namespace {

TEST(GrazeFromRest, agrees_with_fifty_digits) { expect_agreement("graze_from_rest"); }

TEST(GrazeFromRest, contact_is_where_the_closed_form_meets_the_stop) {
  for (const char* what : {"1e-2 past", "1e-6 past", "1e-12 past"}) {
    const Case& one = case_of("graze_from_rest", what);
    const accuracy::Event contact = accuracy::record_of(one.scene, one.duration).events.at(0);
    const long double tau = contact.time, x = (2 * sinl(tau) - sinl(2 * tau)) / 3,
                      v = 2 * (cosl(tau) - cosl(2 * tau)) / 3;
    EXPECT_LT(contact.time, 2 * std::numbers::pi / 3) << what;  // x grows until then, so this contact is the first
    EXPECT_NEAR(static_cast<double>(x), one.scene.stops.upper, 2 * epsilon<double>()) << what;
    // the time to rounding over speed, and the speed to the deceleration 3^(1/2) times that
    EXPECT_NEAR(static_cast<double>(v), contact.speed(), 4 * epsilon<double>() / contact.speed()) << what;
  }
}

TEST(GrazeFromRest, a_miss_by_1e_12_is_a_miss) {
  const Case& miss = case_of("graze_from_rest", "missed by 1e-12");
  EXPECT_TRUE(accuracy::record_of(miss.scene, miss.duration).events.empty());
}

}  // namespace
}  // namespace clatter::hard::graze_from_rest_test
