#include "scene/parameter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "math/dual.hpp"
#include "math/fifty_digits.hpp"
#include "support/random.hpp"

namespace clatter::parameter_test {
namespace {

TEST(Parameter, is_found_by_its_key) {
  for (const Parameter parameter : all_parameters)
    EXPECT_EQ(Parameter::of(parameter.key(), parameter.row().quantity), parameter) << parameter.key();
  EXPECT_EQ(Parameter::of("tau"), std::nullopt);
  EXPECT_FALSE(Parameter::of("stop_damping")->row().is_with_unit);
  EXPECT_TRUE(Parameter::of("stop_damping", Quantity::damping)->row().is_with_unit);
}

/// Each key sets a number that no other key of the same section sets, but those of both stops and the ways to give the
/// damping; and the number that was set is read back.
TEST(Parameter, sets_a_number_of_its_own) {
  for (const char* const section : {"scene", "machine"}) {
    std::set<const double*> places;
    GivenScene given;
    for (const Parameter parameter : all_parameters) {
      if (!parameter.is_in(section)) continue;
      set(given, parameter, 0.75);
      EXPECT_EQ(value_of(given, parameter), 0.75) << parameter.key();
      if (!parameter.is_of_both()) {
        EXPECT_TRUE(places.insert(&parameter.row().place(given)).second) << parameter.key();
      }
    }
  }
}

TEST(Parameter, of_both_stops_sets_each_and_the_sign_of_a_distance_does_not_matter) {
  for (const double value : {-0.75, 0.75}) {
    GivenScene given;
    set(given, "xs", value);
    EXPECT_EQ(given.stops.lower, -0.75);
    EXPECT_EQ(given.stops.upper, 0.75);
  }
  GivenScene given;
  set(given, "R", 0.7);
  set(given, "R_upper", 0.3);
  EXPECT_EQ(given.stops.restitution_lower, 0.7);
  EXPECT_EQ(given.stops.restitution_upper, 0.3);
  EXPECT_TRUE(Parameter("gap").stands_for("stop_lower"));
  EXPECT_FALSE(Parameter("R").stands_for("stop_lower"));
}

TEST(Parameter, of_one_stop_a_load_or_a_part_of_the_force_breaks_symmetry) {
  for (const Parameter parameter : all_parameters) {
    const std::string key(parameter.key());
    const bool is_of_one = key.ends_with("_lower") || key.ends_with("_upper");
    const bool is_load = key == "load" || key == "loose_load",
               is_even = parameter.role() == Role::force_order && std::string("2468").find(key.back()) < 4,
               is_part = is_even || key == "force_duty" || key == "force_rise" || key == "force_factor";
    EXPECT_EQ(parameter.keeps_symmetry(), !is_of_one && !is_load && !is_part) << key;
  }
}

TEST(StartPeriod, starts_on_the_lower_stop_with_the_speed_of_the_motion_that_has_this_period) {
  // T = 4 arcsin(g/V) and |x'| at contact sqrt(V^2 - g^2), so that v0 = g cot(T/4)
  const double g = 0.75, V = 1.3;
  GivenScene given;
  set(given, "xs", -g);
  set(given, "start_period", 4 * std::asin(g / V));
  const Scene scene = computed(given).first;
  EXPECT_EQ(scene.start.displacement, -g);
  EXPECT_NEAR(scene.start.velocity, std::sqrt(V * V - g * g), 4e-16 * 8);  // a few roundings of arcsin and tan
}

/// A machine with every number other than its neutral one.
GivenScene any_machine(support::Random& random) {
  GivenScene given;
  given.is_si = true;
  given.mass = random.logarithmic(1e-3, 1e3);
  const double rate = random.logarithmic(1, 1e3), force = given.mass * rate * rate;
  given.oscillator = {0, random.uniform(-1, 1) * force, rate / 6, random.uniform(-1, 1) * force,
                      random.sign() * random.uniform(0.5, 2) * force};
  given.damper = random.uniform(0, 1) * given.mass * rate;
  given.damping_ratio = random.uniform(0, 1), given.quality = random.uniform(1, 5);
  given.stops = {-random.uniform(0.5, 2),
                 random.uniform(0.5, 2),
                 0.6,
                 0.7,
                 random.uniform(3, 20) * force,
                 random.uniform(3, 20) * force,
                 random.uniform(0, 1),
                 random.uniform(0, 1)};
  given.stop_damper_lower = random.uniform(0, 1) * given.mass * rate;
  given.stop_damper_upper = random.uniform(0, 1) * given.mass * rate;
  given.stop_restitution_lower = random.uniform(0.01, 1), given.stop_restitution_upper = random.uniform(0.01, 1);
  given.start = {random.uniform(-0.1, 0.1), random.uniform(-1, 1), random.uniform(0, 6)};
  return given;
}

/// The numbers of a computed scene.
template <class Number>
std::vector<Number> numbers_in(const BasicScene<Number>& scene) {
  const auto& [h, f, nu, load, k, shape, paces] = scene.oscillator;
  const auto& s = scene.stops;
  return {h,
          f,
          nu,
          load,
          k,
          s.lower,
          s.upper,
          s.restitution_lower.R,
          s.restitution_upper.R,
          s.stiffness_lower,
          s.stiffness_upper,
          s.damping_lower,
          s.damping_upper,
          scene.start.displacement,
          scene.start.velocity};
}

/// The derivative by a key of a machine is the conversion itself on numbers that carry it: against differences in 50
/// digits, whose error is the square of their step.
TEST(Computed, has_the_derivatives_by_every_key_that_differences_in_fifty_digits_have) {
  using Along = Dual<double, 1>;
  for (std::uint64_t i = 0; i < 50; ++i) {
    support::Random random(44, i);
    const GivenScene given = any_machine(random);
    const Units units = natural_units(given);
    for (const Parameter parameter : all_parameters) {
      if (!parameter.is_in("machine")) continue;
      const double value = value_of(given, parameter);
      auto varied = with_numbers<Along>(given);
      set(varied, parameter, Along(value, 0));
      const std::vector<Along> exact = numbers_in(computed(varied, units));
      const FiftyDigits step = FiftyDigits(value) * FiftyDigits("1e-16");
      const auto at = [&](const FiftyDigits& other) {
        auto moved = with_numbers<FiftyDigits>(given);
        set(moved, parameter, other);
        return numbers_in(computed(moved, units));
      };
      const auto ahead = at(value + step), behind = at(value - step);
      for (std::size_t n = 0; n < exact.size(); ++n) {
        const auto slope = value == 0 ? 0.0 : static_cast<double>(FiftyDigits((ahead[n] - behind[n]) / (2 * step)));
        EXPECT_NEAR(exact[n].slope[0], slope, 1e-13 * std::abs(slope)) << parameter.key() << ' ' << n;
      }
    }
  }
}

}  // namespace
}  // namespace clatter::parameter_test
