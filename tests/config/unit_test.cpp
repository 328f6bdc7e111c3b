#include "config/unit.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <utility>

namespace clatter::config {
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

TEST(Unit, another_dimension_does_not_fit) {
  const std::pair<const char*, Quantity> wrong[] = {{"m", Quantity::time},        {"N", Quantity::stiffness},
                                                    {"rad", Quantity::length},    {"Hz", Quantity::rate},
                                                    {"rad", Quantity::frequency}, {"ms", Quantity::velocity}};
  for (const auto& [unit, quantity] : wrong) {
    ASSERT_TRUE(parse_unit(unit)) << unit;
    EXPECT_FALSE(fits(*parse_unit(unit), quantity)) << unit;
  }
}

TEST(Unit, anything_else_is_no_unit) {
  for (const char* const text : {"", " ", "inch", "m/", "/s", "m^", "m^0", "m99999999999", "m//s", "Nm", "mm 3", "kkg"})
    EXPECT_FALSE(parse_unit(text)) << text;
}

}  // namespace
}  // namespace clatter::config
