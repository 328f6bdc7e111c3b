#include "motion/chatter.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "math/fifty_digits.hpp"
#include "motion/contact.hpp"
#include "support/random.hpp"

namespace clatter::motion::chatter_test {
namespace {

/// Time of all flights of a chatter that begins with a rebound at speed w, flight by flight in 50 digits.
template <Effects E>
FiftyDigits time_of_all_flights(const ArcConstants<FiftyDigits, E>& constants, const Stops& stops, double turns,
                                double w) {
  const auto stop = stop_at<FiftyDigits>(stops, Side::upper);
  FiftyDigits phase = turns, speed = w, total = 0;
  while (speed > 1e-20 * w) {  // the rest takes 1e-20 of the time
    const auto [sine, cosine] = sine_cosine_of_turns(phase);
    const FiftyDigits x = stop.position, v = -speed;
    const Arc<FiftyDigits, E> arc(
        constants, {0, x, v, constants.acceleration(x - constants.equilibrium, v, {sine, cosine}), sine, cosine});
    const auto contact = next_contact(arc, stops, FiftyDigits(1));
    total += contact.elapsed;
    phase += contact.elapsed * constants.nu / (2 * pi<FiftyDigits>());
    speed = stop.law.R * contact.motion.v;
  }
  return total;
}

TEST(Chatter, it_ends_when_flight_by_flight_it_does) {
  constexpr Effects effects{Damping::light, Forcing::regular};
  for (double R : {0.1, 0.5, 0.9})
    for (double h : {0.02, 0.4})
      for (double turns : {0.12, 0.25, 0.4}) {  // the force grows, is greatest, falls
        const Oscillator o{h, 1.0, 0.5, 0.1};
        const Stops stops{-0.5, 0.5, R, R};
        const ArcConstants<double, effects.arc()> constants(o);
        const ArcConstants<FiftyDigits, effects.arc()> reference(o);
        const auto stop = stop_at<double>(stops, Side::upper);
        const auto press = contact_force(constants, stop, sine_cosine_of_turns(turns));
        ASSERT_TRUE(holds(constants, stop, sine_cosine_of_turns(turns)));
        const double low = low_rebound<double>(R) * displacements_beside({o, stops, {}}, Side::upper);
        EXPECT_EQ(low, 1e-12);
        double w = 1e-3;
        while (!chatter_time(constants, stop, press, w, low)) w /= 2;
        EXPECT_GT(w, 1e-8);  // completed before it is negligible
        const double sum = *chatter_time(constants, stop, press, w, low);
        EXPECT_NEAR(sum, static_cast<double>(time_of_all_flights(reference, stops, turns, w)), 5e-16)
            << "R = " << R << ", h = " << h;
      }
}

TEST(Chatter, its_sum_is_of_third_order_with_the_coefficient_it_states) {
  // a tenth of w leaves a thousandth of the error
  constexpr Effects effects{Damping::light, Forcing::regular};
  const double h = 0.3, nu = 0.8;
  const Oscillator o{h, 1.0, nu, 0.0};
  const Stops stops{-0.3, 0.3, 0.6, 0.6};
  const ArcConstants<FiftyDigits, effects.arc()> constants(o);
  const auto stop = stop_at<FiftyDigits>(stops, Side::upper);
  const auto press = contact_force(constants, stop, sine_cosine_of_turns(FiftyDigits(0.15)));
  const double R = 0.6, a = static_cast<double>(press.force), j = static_cast<double>(press.rate) / a,
               bend = -nu * nu * (a + 0.3) / a;
  const double third = (8 * (1 + R * R) * h * h + (10 + 12 * R + 10 * R * R) * h * j +
                        (8 + 12 * R + 8 * R * R) * j * j - 3 * (1 + R) * (1 + R) * bend - 3 * (1 - R) * (1 - R)) /
                       (36 * (1 + R + R * R));
  for (double w : {1e-4, 1e-5}) {
    const FiftyDigits error =
        time_of_all_flights(constants, stops, 0.15, w) - chatter_sum(constants, stop, press, {w}).time;
    EXPECT_NEAR(static_cast<double>(error) / std::pow(2 * w / a / (1 - R), 3), third, 20 * w);
  }
}

TEST(Chatter, its_sum_is_off_by_less_than_its_bound_and_the_bound_is_not_slack) {
  support::Random random(20232, 0);
  double closest = 0;
  for (int i = 0; i < 60; ++i) {
    const double R = random.happens(0.2) ? 1 - random.logarithmic(0.05, 0.1) : random.uniform(0, 0.9);
    const Oscillator o{random.logarithmic(1e-3, 0.99), random.sign(), random.logarithmic(1.1, 30),
                       random.uniform(0, 2)};
    const Stops stops{-2, 0.1, R, R};
    const double turns = random.uniform(0, 1);
    with_any_stops(o, [&]<Effects effects>() {
      const ArcConstants<FiftyDigits, effects.arc()> constants(o);
      const auto stop = stop_at<FiftyDigits>(stops, Side::upper);
      const auto press = contact_force(constants, stop, sine_cosine_of_turns(FiftyDigits(turns)));
      if (!(press.force > 0)) return;
      const double rates = 1 + 2 * o.damping + static_cast<double>(abs(press.rate) / press.force),
                   bend = static_cast<double>(abs(constants.f) / press.force) * o.frequency * o.frequency;
      const double duration = 0.02 / std::max(rates, std::sqrt(bend));  // thousands of times longer than is ever summed
      const double w = duration * (1 - R) / 2 * static_cast<double>(press.force);
      const auto sum = chatter_sum(constants, stop, press, {w});
      const FiftyDigits off = abs(time_of_all_flights(constants, stops, turns, w) - sum.time);
      EXPECT_LE(off, sum.bound) << "R = " << R << ", h = " << o.damping << ", nu = " << o.frequency;
      closest = std::max(closest, static_cast<double>(off / sum.bound));
    });
  }
  EXPECT_GT(closest, 0.1);
}

TEST(Chatter, elastic_stops_and_pulled_masses_have_none) {
  const ArcConstants<double, Effects{Damping::light, Forcing::regular}> constants({0.1, 1.0, 0.5, 0.0});
  const auto elastic = stop_at<double>({-0.5, 0.5, 1.0, 1.0}, Side::upper);
  const auto lossy = stop_at<double>({-0.5, 0.5, 0.5, 0.5}, Side::upper);
  EXPECT_FALSE(chatter_time(constants, elastic, {0.5, 0.0}, 1e-12, 1e-12));
  EXPECT_FALSE(chatter_time(constants, lossy, {-0.5, 0.0}, 1e-12, 1e-12));
  EXPECT_FALSE(chatter_time(constants, lossy, {0.0, 1.0}, 1e-12, 1e-12));
  EXPECT_TRUE(chatter_time(constants, lossy, {0.5, 0.0}, 1e-12, 1e-12));
}

TEST(Chatter, high_rebounds_are_no_part_of_a_sum) {
  // without a spring and a damper the sum is exact for every rebound; its height w^2 / 2a decides
  const ArcConstants<double, Effects{.stiffness = true}.arc()> ball({0, 0, 1, -2, 0});
  const auto floor = stop_at<double>({0, 1e9, 0.5, 0.5}, Side::lower);
  EXPECT_FALSE(chatter_time(ball, floor, {2.0, 0.0}, 2.01e-6, 1e-12));
  EXPECT_DOUBLE_EQ(chatter_time(ball, floor, {2.0, 0.0}, 1.99e-6, 1e-12).value_or(0), 2 * 1.99e-6);
}

TEST(Chatter, rebounds_are_compared_with_the_displacements_of_the_scene) {
  const auto beside = [](const Oscillator& o, const Stops& stops, const Start& start) {
    return displacements_beside({o, stops, start}, Side::lower);
  };
  const Stops apart{-0.5, 0.5, 0.5, 0.5}, one{2, std::numeric_limits<double>::infinity(), 0.5, 0.5};
  EXPECT_EQ(beside({0.1, 0.5, 0.8, 0}, apart, {}), 0.5);           // the response of a stiff spring
  EXPECT_EQ(beside({0.1, -0.5, 4, 0}, apart, {}), 0.5 / 16);       // that of a mass
  EXPECT_EQ(beside({100, 0.5, 1, 0}, apart, {}), 0.5 / 200);       // that of a damper
  EXPECT_EQ(beside({0.1, 3, 0.8, 0}, apart, {}), 1);               // the stops
  EXPECT_EQ(beside({0.1, 3, 0.8, 0}, one, {7, 8, 0}), 3);          // forced: whatever the start is
  EXPECT_EQ(beside({0, 0, 1, -9, 0}, one, {2.5, 6, 0}), 0.5 + 2);  // a ball
  EXPECT_EQ(beside({3, 0, 1, -9, 0}, one, {2.5, 6, 0}), 0.5 + 1);  // stopped by the damper
  EXPECT_EQ(beside({0, 0, 1, -1, 1}, one, {2.5, 6, 0}), 0.5 + 6);  // and by the spring, the stop at -3 from rest
  EXPECT_EQ(beside({0, 0, 1, -9, 0}, one, {2, 0, 0}), 0);          // at rest
}

}  // namespace
}  // namespace clatter::motion::chatter_test
