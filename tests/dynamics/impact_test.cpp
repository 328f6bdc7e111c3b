#include "dynamics/impact.hpp"

#include <gtest/gtest.h>

#include "dynamics/contact.hpp"
#include "numbers/fifty_digits.hpp"

namespace clatter {
namespace {

using Light = Flow<double, Effects{Damping::light, Forcing::regular}>;

TEST(Impact, a_stop_releases_where_the_pressing_force_falls_to_zero) {
  for (double f : {1.0, -1.0})
    for (double load : {0.0, 0.2})
      for (const Side side : {Side::lower, Side::upper}) {
        const Light flow({0.1, f, 0.5, load});
        const auto stop = stop_at<double>({-0.5, 0.5, 0.5, 0.5}, side);
        const auto turns = release_phase(flow, stop);
        ASSERT_TRUE(turns);
        EXPECT_TRUE(*turns >= 0.0 && *turns < 1.0);
        const auto press = pressing(flow, stop, sine_cosine_of_turns(*turns));
        EXPECT_NEAR(press.force, 0.0, 4e-16);
        EXPECT_LT(press.rate, 0.0);
      }
}

TEST(Impact, a_force_below_the_gap_never_releases) {
  const auto upper = stop_at<double>({-0.5, 0.5, 0.5, 0.5}, Side::upper);
  EXPECT_FALSE(release_phase(Light({0.1, 0.4, 0.5, 1.0}), upper));  // load 1 presses with 0.5 +- 0.4
  EXPECT_FALSE(release_phase(Light({0.1, 0.5, 0.5, 1.0}), upper));  // the force just touches zero
  EXPECT_TRUE(release_phase(Light({0.1, 0.5000001, 0.5, 1.0}), upper));
}

/// Time of all flights of a chatter that begins with a rebound at speed w, flight by flight in 50 digits.
template <Effects E>
FiftyDigits time_of_all_flights(const Flow<FiftyDigits, E>& flow, const Stops& stops, double turns, double w) {
  const auto stop = stop_at<FiftyDigits>(stops, Side::upper);
  FiftyDigits phase = turns, speed = w, total = 0;
  while (speed > 1e-40) {
    const auto [sine, cosine] = sine_cosine_of_turns(phase);
    const FiftyDigits x = stop.place, v = -speed;
    const Arc<FiftyDigits, E> arc(flow, {0, x, v, flow.acceleration(x, v, sine), sine, cosine});
    const auto contact = next_contact(arc, stops, FiftyDigits(1));
    total += contact.elapsed;
    phase += contact.elapsed * flow.nu / (2 * pi<FiftyDigits>());
    speed = stop.restitution * contact.motion.v;
  }
  return total;
}

TEST(Impact, chatter_ends_when_flight_by_flight_it_does) {
  constexpr Effects effects{Damping::light, Forcing::regular};
  for (double R : {0.1, 0.5, 0.9})
    for (double h : {0.02, 0.4})
      for (double turns : {0.12, 0.25, 0.4}) {  // the force grows, is greatest, falls
        const Oscillator o{h, 1.0, 0.5, 0.1};
        const Stops stops{-0.5, 0.5, R, R};
        const Flow<double, effects> flow(o);
        const Flow<FiftyDigits, effects> reference(o);
        const auto stop = stop_at<double>(stops, Side::upper);
        const auto press = pressing(flow, stop, sine_cosine_of_turns(turns));
        ASSERT_TRUE(holds(flow, stop, sine_cosine_of_turns(turns)));
        double w = 1e-3;
        while (!chatter_time(flow, stop, press, w)) w /= 2;
        EXPECT_GT(w, 1e-8);  // completed while there is something to complete
        const double sum = *chatter_time(flow, stop, press, w);
        EXPECT_NEAR(sum, static_cast<double>(time_of_all_flights(reference, stops, turns, w)), 5e-16)
            << "R = " << R << ", h = " << h;
      }
}

TEST(Impact, next_order_term_of_the_chatter_series_is_right) {
  // summed in 50 digits, what is left out is of third order in w: a tenth of w leaves a thousandth of the error
  constexpr Effects effects{Damping::light, Forcing::regular};
  const Oscillator o{0.3, 1.0, 0.8, 0.0};
  const Stops stops{-0.3, 0.3, 0.6, 0.6};
  const Flow<FiftyDigits, effects> flow(o);
  const auto stop = stop_at<FiftyDigits>(stops, Side::upper);
  const auto press = pressing(flow, stop, sine_cosine_of_turns(FiftyDigits(0.15)));
  const auto error = [&](double w) {
    const FiftyDigits first = 2 / (press.force * (1 - stop.restitution)), tiny = 1e-30;
    // the coefficient of w^2, read off chatter_time itself where it may be summed
    const FiftyDigits second = (*chatter_time(flow, stop, press, tiny) / tiny - first) / tiny;
    return static_cast<double>(abs(time_of_all_flights(flow, stops, 0.15, w) - FiftyDigits(w) * (first + second * w)));
  };
  EXPECT_NEAR(error(1e-4) / error(1e-5), 1000.0, 30.0);
}

TEST(Impact, elastic_stops_and_pulled_masses_have_no_chatter) {
  const Light flow({0.1, 1.0, 0.5, 0.0});
  const auto elastic = stop_at<double>({-0.5, 0.5, 1.0, 1.0}, Side::upper);
  const auto lossy = stop_at<double>({-0.5, 0.5, 0.5, 0.5}, Side::upper);
  EXPECT_FALSE(chatter_time(flow, elastic, {0.5, 0.0}, 1e-12));
  EXPECT_FALSE(chatter_time(flow, lossy, {-0.5, 0.0}, 1e-12));
  EXPECT_FALSE(chatter_time(flow, lossy, {0.0, 1.0}, 1e-12));
  EXPECT_TRUE(chatter_time(flow, lossy, {0.5, 0.0}, 1e-12));
}

}  // namespace
}  // namespace clatter
