// A mass on its steady motion that just reaches the stops: the speed at contact goes with the square root of the depth
// of the stops in its way (eq. 20), and every later contact multiplies the rounding of the one before by about its
// inverse.

#include <gtest/gtest.h>

#include <cmath>

#include "hard/measure.hpp"

namespace clatter::hard::graze_test {
namespace {

TEST(Graze, agrees_with_fifty_digits) { expect_agreement("graze"); }

TEST(Graze, first_contact_has_its_time_and_speed) {
  const double nu = 1.5, amplitude = 0.777909841584413976;
  const struct {
    const char* what;
    double past, time;
  } rows[] = {{"1e-2 past", 1e-2, 0.79580791516640404},
              {"1e-6 past", 1e-6, 0.88922475492920602},
              {"1e-10 past", 1e-10, 0.89015813595893962}};
  for (const auto& [what, past, time] : rows) {
    const accuracy::Event first = accuracy::record_of(case_of("graze", what).scene, 1.0).events.at(0);
    const double speed = nu * amplitude * std::sqrt(past * (2 - past));
    EXPECT_EQ(first.side, Side::lower);
    // an ulp of the amplitude moves the time by itself over the speed, and the speed by the acceleration times that
    const double rounding = 4 * epsilon<double>() * amplitude / speed;
    EXPECT_NEAR(first.time, time, rounding) << what;
    EXPECT_NEAR(first.speed(), speed, nu * nu * amplitude * rounding) << what;
  }
}

TEST(Graze, a_miss_by_1e_12_is_a_miss_ten_thousand_times) {
  const Case& miss = case_of("graze", "missed by 1e-12");
  const accuracy::RunRecord record = accuracy::record_of(miss.scene, miss.duration);
  EXPECT_EQ(record.outcome, stepping::Outcome::completed);
  EXPECT_TRUE(record.events.empty());
}

}  // namespace
}  // namespace clatter::hard::graze_test
