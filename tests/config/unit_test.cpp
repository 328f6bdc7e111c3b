#include "config/unit.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "config/unit_hint.hpp"

namespace clatter::config::unit_test {
namespace {

/// A value in a written unit, in SI; NaN if the unit isn't one or doesn't fit.
double si(double value, const char* unit, Quantity quantity) {
  const auto parsed = parse_unit(unit);
  return parsed && fits(*parsed, quantity) ? in_si(value, *parsed, quantity) : std::numeric_limits<double>::quiet_NaN();
}

TEST(Unit, powers_of_ten_are_one_rounding) {
  // equal, not near: the quotient of two numbers that are exact is the nearest double, as is the literal
  EXPECT_EQ(si(3, "mm", Quantity::length), 0.003);
  EXPECT_EQ(si(7, "\u00B5m", Quantity::length), 7e-6);
  EXPECT_EQ(si(7, "um", Quantity::length), 7e-6);
  EXPECT_EQ(si(250, "g", Quantity::mass), 0.25);
  EXPECT_EQ(si(2, "kg", Quantity::mass), 2);
  EXPECT_EQ(si(3, "kN/mm", Quantity::stiffness), 3e6);
}

TEST(Unit, products_and_quotients) {
  for (const char* const unit : {"N s/m", "N*s/m", "N s m-1", "kg/s", "N s m^-1"})
    EXPECT_EQ(si(5, unit, Quantity::damping), 5) << unit;
  for (const char* const unit : {"m/s", "m s-1", "mm/ms"}) EXPECT_EQ(si(5, unit, Quantity::velocity), 5) << unit;
  EXPECT_EQ(si(5, "kg m/s^2", Quantity::force), 5);
}

TEST(Unit, frequencies_are_in_cycles_and_angles_in_rad) {
  EXPECT_EQ(si(25, "Hz", Quantity::frequency), 25);
  EXPECT_EQ(si(2, "kHz", Quantity::frequency), 2000);
  EXPECT_DOUBLE_EQ(si(2 * std::numbers::pi, "rad/s", Quantity::frequency), 1);  // a power and a product: two roundings
  EXPECT_EQ(si(0.5, "rad", Quantity::angle), 0.5);
}

TEST(Unit, turns_a_minute_are_a_sixtieth_of_a_hertz) {
  for (const char* const unit : {"rpm", "1/min", "1 / min", "min-1", "min^-1"})
    EXPECT_EQ(si(1500, unit, Quantity::frequency), 25) << unit;
  EXPECT_EQ(si(3, "min", Quantity::time), 180);
  EXPECT_EQ(si(120, "m/min", Quantity::velocity), 2);
}

TEST(Unit, degrees_are_parts_of_a_turn_and_percent_of_one) {
  for (const char* const unit : {"deg", "\u00B0"}) {
    // equal, not near: quarters of 180 are exact, and times pi is one rounding, as in the text pi/2
    EXPECT_EQ(si(90, unit, Quantity::angle), std::numbers::pi / 2) << unit;
    EXPECT_EQ(si(-45, unit, Quantity::angle), -std::numbers::pi / 4) << unit;
  }
  EXPECT_DOUBLE_EQ(si(720, "deg/s", Quantity::frequency), 2);
  EXPECT_EQ(si(60, "%", Quantity::number), 0.6);
  EXPECT_EQ(si(3, "%", Quantity::number), 0.03);
}

TEST(Unit, another_dimension_does_not_fit) {
  const std::pair<const char*, Quantity> wrong[] = {
      {"m", Quantity::time},        {"N", Quantity::stiffness},   {"rad", Quantity::length},
      {"Hz", Quantity::rate},       {"rad", Quantity::frequency}, {"ms", Quantity::velocity},
      {"1/s", Quantity::frequency}, {"1/min", Quantity::angle},   {"rpm", Quantity::rate},
      {"deg", Quantity::number},    {"%", Quantity::angle},       {"%", Quantity::length}};
  for (const auto& [unit, quantity] : wrong) {
    ASSERT_TRUE(parse_unit(unit)) << unit;
    EXPECT_FALSE(fits(*parse_unit(unit), quantity)) << unit;
  }
}

TEST(Unit, anything_else_is_no_unit) {
  for (const char* const text : {"", " ", "inch", "m/", "/s", "m^", "m^0", "m99999999999", "m//s", "Nm", "mm 3", "kkg",
                                 "kmin", "mdeg", "m%", "1", "1/", "1/1"})
    EXPECT_FALSE(parse_unit(text)) << text;
}

/// A unit that isn't known, and the one that is meant.
struct Meant {
  const char* unit;
  Quantity quantity;
  const char* known;
};

TEST(UnitHint, names_the_unit_that_was_meant) {
  using enum Quantity;
  const Meant table[] = {{"gramm", mass, "g"},
                         {"grams", mass, "g"},
                         {"Kg", mass, "kg"},
                         {"kilograms", mass, "kg"},
                         {"Ns/m", damping, "N s/m"},
                         {"kNs/m", damping, "kN s/m"},
                         {"N/(m/s)", damping, "N s/m"},
                         {"N\u00B7s/m", damping, "N s/m"},
                         {"N/(mm s-1)", damping, "N s/mm"},
                         {"kN/Meter", stiffness, "kN/m"},
                         {"hz", frequency, "Hz"},
                         {"khz", frequency, "kHz"},
                         {"U/min", frequency, "rpm"},
                         {"RPM", frequency, "rpm"},
                         {"rev/min", frequency, "rpm"},
                         {"s\u207B\u00B9 rad", frequency, "rad/s"},
                         {"degrees", angle, "deg"},
                         {"\u00BA", angle, "\u00B0"},
                         {"micron", length, "um"},
                         {"MM", length, "mm"},
                         {"sec", time, "s"},
                         {"minutes", time, "min"},
                         {"newtons", force, "N"},
                         {"kn", force, "kN"},
                         {"kg m/s\u00B2", force, "kg m/s2"},
                         {"percent", number, "%"}};
  for (const auto& [unit, quantity, known] : table) {
    EXPECT_FALSE(parse_unit(unit)) << unit;
    EXPECT_EQ(unit_hint(unit, quantity), std::string("; did you mean '") + known + "'?") << unit;
  }
}

TEST(UnitHint, converts_units_that_are_not_read) {
  // by definition: the inch, the pound, the pound of force and the kilopond in SI
  EXPECT_EQ(unit_hint("inch", Quantity::length), "; 1 inch is 25.4 mm");
  EXPECT_EQ(unit_hint("lb", Quantity::mass), "; 1 lb is 0.45359237 kg");
  EXPECT_EQ(unit_hint("lbf", Quantity::force), "; 1 lbf is 4.4482216152605 N");
  EXPECT_EQ(unit_hint("kp/mm", Quantity::stiffness), "; 1 kp/mm is 9.80665 N/mm");
  EXPECT_EQ(unit_hint("in/sec", Quantity::velocity), "; 1 in/sec is 25.4 mm/s");
}

TEST(UnitHint, is_silent_where_nothing_known_fits) {
  for (const char* const unit : {"", "gramm", "furlong", "N/(", "()", "(((((", "^2", "m^^2", "1", "//"})
    EXPECT_EQ(unit_hint(unit, Quantity::length), "") << unit;
}

}  // namespace
}  // namespace clatter::config::unit_test
