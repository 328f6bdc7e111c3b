#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "math/fifty_digits.hpp"
#include "motion/chatter.hpp"
#include "motion/dry_friction.hpp"
#include "motion/first_crossing.hpp"
#include "support/random.hpp"

namespace clatter::motion::rubbing_chatter_test {
namespace {

constexpr Effects of_arcs = effect_sets::with_friction(Damping::light, Forcing::secular).arc();
using Constants = ArcConstants<FiftyDigits, of_arcs>;

/// A mass that chatters on the upper stop, and rubs.
struct Rubbing {
  Oscillator oscillator;
  double stop, R, friction, turns;  ///< turns: the forcing phase at the rebound

  [[nodiscard]] Stops stops() const { return {-10, stop, R, R}; }
  [[nodiscard]] ContactForce<FiftyDigits> press(const Constants& constants) const {
    return contact_force(constants, stop_at<FiftyDigits>(stops(), Side::upper),
                         sine_cosine_of_turns(FiftyDigits(turns)));
  }
  [[nodiscard]] ChatterSum<FiftyDigits> sum(const Constants& constants, double w) const {
    return rubbing_chatter_sum(constants, stop_at<FiftyDigits>(stops(), Side::upper), press(constants),
                               FiftyDigits(friction), FiftyDigits(w));
  }
};

/// Time of all flights of a chatter that begins with a rebound at speed w, each of them a slip away from the stop and
/// one back to it.
FiftyDigits time_of_all_flights(const Rubbing& rubbing, double w) {
  const Constants still(rubbing.oscillator);
  const Slips<FiftyDigits, of_arcs> slips(still, Friction{rubbing.friction, rubbing.friction}, rubbing.stops());
  const FiftyDigits position(rubbing.stop);
  FiftyDigits phase = rubbing.turns, speed = w, total = 0;
  const auto slip = [&](Side side, const FiftyDigits& offset, const FiftyDigits& v, const Margin<FiftyDigits>& margin) {
    const auto [sine, cosine] = sine_cosine_of_turns(phase);
    const Constants& constants = slips.towards(side);
    const FiftyDigits x = position + offset;
    const Arc<FiftyDigits, of_arcs> arc(
        constants, {offset, x, v, constants.acceleration(x - constants.equilibrium, v, {sine, cosine}), sine, cosine},
        position);
    const auto end = first_crossing(arc, std::array{margin}, FiftyDigits(1));
    total += end.elapsed, phase += end.elapsed * constants.nu / (2 * pi<FiftyDigits>());
    return end.motion;
  };
  while (speed > 1e-20 * w) {  // the rest takes 1e-20 of the time
    const auto peak = slip(Side::lower, 0, -speed, {0, 0, -1});
    speed = rubbing.R * slip(Side::upper, peak.offset, 0, {0, -1, 0}).v;
  }
  return total;
}

TEST(RubbingChatter, its_sum_is_of_third_order) {
  // a tenth of w leaves a thousandth of the error
  const Rubbing rubbing{{0.3, 1.0, 0.8, 0.0}, 0.3, 0.6, 0.2, 0.15};
  const Constants constants(rubbing.oscillator);
  const auto error = [&](double w) {
    return static_cast<double>(time_of_all_flights(rubbing, w) - rubbing.sum(constants, w).time);
  };
  EXPECT_NEAR(error(1e-5) / error(1e-4), 1e-3, 2e-6);
}

TEST(RubbingChatter, without_friction_it_is_the_sum_without) {
  const Rubbing rubbing{{0.3, 1.0, 0.8, 0.0}, 0.3, 0.6, 0.0, 0.15};
  const Constants constants(rubbing.oscillator);
  const auto plain = chatter_sum(constants, stop_at<FiftyDigits>(rubbing.stops(), Side::upper),
                                 rubbing.press(constants), FiftyDigits(1e-4));
  EXPECT_LE(abs(rubbing.sum(constants, 1e-4).time / plain.time - 1), 1e-45);
}

TEST(RubbingChatter, its_sum_is_off_by_less_than_its_bound_and_the_bound_is_not_slack) {
  double closest = 0;
  int summed = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    support::Random random(20247, i);
    Rubbing rubbing{{random.logarithmic(1e-3, 0.9), random.sign(), random.logarithmic(1.1, 30), random.uniform(0, 2)},
                    0.1,
                    random.happens(0.2) ? 1.0 : random.uniform(0, 0.95),
                    0,
                    random.uniform(0, 1)};
    const Constants constants(rubbing.oscillator);
    const auto press = rubbing.press(constants);
    const double a = static_cast<double>(press.force);
    if (!(a > 0)) continue;
    rubbing.friction = a * random.uniform(0.02, 0.95);
    const double down = a - rubbing.friction;
    const double rates = 1 + 2 * rubbing.oscillator.damping + std::abs(static_cast<double>(press.rate)) / down,
                 bend = rubbing.oscillator.frequency * rubbing.oscillator.frequency / down;
    const double duration = 0.02 / std::max(rates, std::sqrt(bend));
    const double w = duration / static_cast<double>(rubbing.sum(constants, 1e-20).time / 1e-20);
    const auto sum = rubbing.sum(constants, w);
    const FiftyDigits off = abs(time_of_all_flights(rubbing, w) - sum.time);
    EXPECT_LE(off, sum.bound) << i;
    closest = std::max(closest, static_cast<double>(off / sum.bound)), ++summed;
  }
  EXPECT_GT(summed, 25);
  EXPECT_GT(closest, 0.1);
}

TEST(RubbingChatter, is_not_summed_where_the_mass_may_stick_off_the_stop) {
  const Rubbing rubbing{{0.1, 1.0, 0.8, 0.0}, 0.3, 0.6, 0.2, 0.25};  // pressed by 0.7, at its greatest
  const ArcConstants<double, of_arcs> constants(rubbing.oscillator);
  const auto stop = stop_at<double>(rubbing.stops(), Side::upper);
  const auto press = contact_force(constants, stop, sine_cosine_of_turns(0.25));
  const auto time = [&](double static_level) {
    return rubbing_chatter_time(constants, stop, press, 0.2, static_level, 1e-8, 1e-12, epsilon<double>());
  };
  EXPECT_TRUE(time(0.2));
  EXPECT_TRUE(time(0.699));
  EXPECT_FALSE(time(0.7));
  EXPECT_FALSE(time(0.8));
}

}  // namespace
}  // namespace clatter::motion::rubbing_chatter_test
