// R close to 1: a chatter of thousands or millions of impacts, each of which affects its end.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hard/measure.hpp"

namespace clatter::hard::near_elastic_chatter_test {
namespace {

TEST(NearElasticChatter, agrees_with_fifty_digits) {
  expect_agreement(case_of("near_elastic_chatter", "R = 0.99"));
  expect_agreement(case_of("near_elastic_chatter", "R = 0.99, slow force"));
}

/// End of the chatter of a mass that a load of 1 presses onto a stop at 0.5, from rest at 0: it turns about x = 1, so a
/// flight that begins with speed w takes 2 arctan(w/0.5).
long double end_of_chatter(long double R) {
  long double total = 0, w = sinl(std::numbers::pi_v<long double> / 3);
  std::vector<long double> flights;
  for (w *= R; w > 1e-22L; w *= R) flights.push_back(2 * atanl(2 * w));
  for (auto flight = flights.rbegin(); flight != flights.rend(); ++flight) total += *flight;
  return std::numbers::pi_v<long double> / 3 + total;
}

TEST(NearElasticChatter, ends_where_the_sum_of_its_flights_says) {
  for (const char* what : {"R = 0.99", "R = 0.999", "R = 0.99999"}) {
    const Case& one = case_of("near_elastic_chatter", what);
    const double R = one.scene.stops.restitution_upper.R, end = static_cast<double>(end_of_chatter(R));
    Measured m;
    m.record = accuracy::record_of(one.scene, one.duration);
    ASSERT_EQ(m.record.outcome, stepping::Outcome::completed) << what;
    ASSERT_EQ(m.record.events.back().kind, accuracy::Event::Kind::rest) << what;
    for (const accuracy::Event& event : m.record.events) {
      if (event.kind == accuracy::Event::Kind::impact) ++m.impacts;
      if (event.kind != accuracy::Event::Kind::rest || m.rests == 1) continue;  // the others continue it
      m.rests = 1;
      m.error = std::abs(event.time - end) / one.duration;
      EXPECT_NEAR(event.time / end, 1.0, 1e-12) << what;
    }
    // an ulp of R moves the end by itself over 1 - R
    m.one_ulp =
        std::abs(static_cast<double>(end_of_chatter(R * (1 - epsilon<double>())) - end_of_chatter(R))) / one.duration;
    EXPECT_LE(m.error, 64 * m.one_ulp) << what;
    // speeds fall by R from 1 to the cube root of rounding times 1 - R, from which on the sum is as good as its flights
    EXPECT_LE(m.record.impacts, 30 / (1 - R)) << what;
    if (one.what != "R = 0.99") report(one, m);
  }
}

}  // namespace
}  // namespace clatter::hard::near_elastic_chatter_test
