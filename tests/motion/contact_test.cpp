#include "motion/contact.hpp"

#include <gtest/gtest.h>

#include <random>

#include "motion/scenes.hpp"

namespace clatter::motion::contact_test {
namespace {

TEST(Contact, grazing_contact_is_found_at_its_time_with_its_speed) {
  const struct {
    double past, time;  // 50 digits
  } rows[] = {{1e-2, 0.79580791516640404}, {1e-6, 0.88922475492920602}, {1e-10, 0.89015813595893962}};
  for (const auto& [past, time] : rows) {
    const Crossing<double> contact = first_contact(graze::oscillator, graze::stops(past), graze::x0, graze::v0, 4.0);
    EXPECT_EQ(contact.side, Side::lower);
    const double nu = graze::oscillator.frequency, speed = nu * graze::amplitude * std::sqrt(past * (2 - past));
    // conditioning (eq. 21): a few ulps of the amplitude move the time by themselves over the speed, and the speed by
    // the acceleration times that
    const double rounding = 4 * epsilon<double>() * graze::amplitude / speed;
    EXPECT_NEAR(contact.elapsed, time, rounding);
    EXPECT_NEAR(-contact.motion.v, speed, nu * nu * graze::amplitude * rounding);
  }
}

TEST(Contact, a_miss_by_1e_12_is_a_miss) {
  const Crossing<double> contact = first_contact(graze::oscillator, graze::stops(-1e-12), graze::x0, graze::v0, 100.0);
  EXPECT_EQ(contact.side, Side::none);
  EXPECT_TRUE(contact.resolved);
  EXPECT_EQ(contact.elapsed, 100.0);
}

TEST(Contact, agrees_with_a_dense_scan_on_random_scenes) {
  std::mt19937_64 random(20231);
  std::uniform_real_distribution<double> unit(0, 1);
  int contacts = 0;
  for (int scene = 0; scene < 2000; ++scene) {
    const Oscillator o{unit(random) < 0.2 ? 0.0 : 2 * unit(random) * unit(random), 2 * unit(random) - 1,
                       0.1 + 3 * unit(random), 0.2 * unit(random)};
    const Stops stops{-0.05 - unit(random), 0.05 + unit(random), 0.7, 0.7};
    const double x = stops.lower + (stops.upper - stops.lower) * unit(random), v = 2 * unit(random) - 1, horizon = 8.0;
    const Crossing<double> contact = first_contact(o, stops, x, v, horizon);
    ASSERT_TRUE(contact.resolved);
    contacts += contact.side != Side::none;
    with_any_stops(o, [&]<Effects effects>() {
      const ArcConstants<double, effects.arc()> constants(o);
      const Arc<double, effects.arc()> arc(
          constants, {0, x, v, constants.acceleration(x - constants.equilibrium, v, {0.0, 1.0}), 0, 1});
      for (double s = 0; s < contact.elapsed; s += 1e-3) {
        const double at = arc.at(s).x;
        EXPECT_TRUE(at >= stops.lower - 1e-14 && at <= stops.upper + 1e-14) << "scene " << scene << ", s = " << s;
      }
      if (contact.side != Side::none) {
        const double position = contact.side == Side::upper ? stops.upper : stops.lower;
        EXPECT_NEAR(arc.at(contact.elapsed).x, position, 1e-14);
        EXPECT_GE(contact.motion.v * sign_of(contact.side), 0.0);
      }
    });
  }
  EXPECT_GT(contacts, 1000);  // there are enough contacts that the scan could contradict
}

TEST(Contact, two_contacts_closer_than_any_step_are_not_jumped_over) {
  // a parabola that dips behind the upper stop for 2e-4 in the middle of a long flight
  const Oscillator free{0, 0, 1, 0};
  const double depth = 5e-9, amplitude = 1.0;
  const Crossing<double> contact = first_contact(free, {-2, amplitude - depth, 1, 1}, 0.0, amplitude, 3.0);
  EXPECT_EQ(contact.side, Side::upper);
  EXPECT_NEAR(contact.elapsed, std::asin(amplitude - depth), 1e-15 / std::sqrt(2 * depth));  // rounding over the speed
}

TEST(Contact, a_start_on_a_stop_is_no_contact_unless_it_moves_in) {
  const Oscillator free{0, 0, 1, 0};
  const Stops stops{-1, 0.5, 1, 1};
  const Crossing<double> away = first_contact(free, stops, 0.5, -1.0, 3.0);
  EXPECT_EQ(away.side, Side::lower);  // amplitude sqrt(1.25): it reaches -1 first
  const Crossing<double> in = first_contact(free, stops, 0.5, 1.0, 3.0);
  EXPECT_EQ(in.side, Side::upper);
  EXPECT_EQ(in.elapsed, 0.0);
  const Crossing<double> leaving = first_contact(free, stops, 0.5, 0.0, 3.0);  // the spring pulls it off
  EXPECT_EQ(leaving.side, Side::none);
}

TEST(Contact, micro_flights_keep_their_relative_accuracy) {
  // rebound at speed w from the upper stop, pressed with the acceleration 0.7: s = 2 w/a (1 - ...) (eq. 23), and the
  // flight goes far below an ulp of the stop's position
  const Oscillator pressed{0, 0, 1, 1.2};
  for (double w : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Crossing<double> contact = first_contact(pressed, {-1, 0.5, 1, 1}, 0.5, -w, 3.0);
    EXPECT_EQ(contact.side, Side::upper);
    const double exact = 2 * std::atan2(w, 0.7);  // rotation about x = 1.2
    EXPECT_NEAR(contact.elapsed / exact, 1.0, 1e-14);
    EXPECT_NEAR(contact.motion.v / w, 1.0, 1e-14);
  }
}

TEST(Contact, conservative_contacts_keep_the_speed_however_soft) {
  // from a stop to the opposite one the speed is the same, exactly (eq. 17); along the arc it would be lost in the
  // rounding of the displacement
  for (double v : {1.0, 1e-3, 1e-7})
    EXPECT_EQ(first_contact({0, 0, 1, 0}, {-0.75, 0.75, 1, 1}, -0.75, v, 4.0).motion.v, v);
}

TEST(Contact, stops_out_of_reach_cost_one_evaluation) {
  const Crossing<double> contact = first_contact({0.1, 1.0, 1.5, 0}, {-6, 6, 1, 1}, 0, 0, 1000.0);
  EXPECT_EQ(contact.side, Side::none);
  EXPECT_EQ(contact.evaluations, 1);
}

TEST(Contact, lengths_near_the_smallest_numbers_are_solved_or_refused) {
  for (double scale : {1e-150, 1e-250}) {  // squares vanish, the motion is the same
    const Crossing<double> contact = first_contact({0.1, scale, 0.5, 0}, {-scale / 2, scale / 2, 1, 1}, 0, 0, 4.0);
    EXPECT_EQ(contact.side, Side::upper);
    EXPECT_NEAR(contact.elapsed, 2.0515931595927638, 1e-14);  // as at scale 1 (tests/stepping/exact_test.cpp)
  }
  EXPECT_FALSE(first_contact({0.1, 1e-300, 0.5, 0}, {-1e-300, 1e-300, 1, 1}, 0, 0, 4.0).resolved);
  const Crossing<double> decayed =
      first_contact({0.1, 0, 1, 0}, {-1, 1, 1, 1}, 1e-300, 0, 4.0);  // out of reach: no length to resolve
  EXPECT_EQ(decayed.side, Side::none);
  EXPECT_TRUE(decayed.resolved);
}

TEST(Contact, numbers_beyond_the_range_are_not_resolved_rather_than_searched_for_ever) {
  EXPECT_FALSE(first_contact({0.1, 1e308, 1, 0}, {-1, 1, 1, 1}, 0, 1e308, 10.0).resolved);
  EXPECT_FALSE(first_contact({0, 0, 1, 0}, {-1, 1, 1, 1}, 0, std::nan(""), 10.0).resolved);
}

}  // namespace
}  // namespace clatter::motion::contact_test
