#include "config/reading.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "config/config_error.hpp"

namespace clatter::config::reading_test {
namespace {

Reading read(std::string_view text) { return parse_reading({text, {.source = "--where"}}); }

std::string refusal(std::string_view text, std::string_view unit = "m") {
  try {
    (void)in_unit_of_file(read(text), unit, {.source = "--where gap"}, "'gap' in 'a.h5'");
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

TEST(Reading, has_the_quantity_that_its_unit_says) {
  struct Case {
    std::string_view text;
    double value;
    Quantity quantity;
  };
  for (const auto& [text, value, quantity] :
       {Case{"1.5 mm", 0.0015, Quantity::length}, Case{"-3", -3.0, Quantity::number},
        Case{"pi/2", std::numbers::pi / 2, Quantity::number}, Case{"25 Hz", 25.0, Quantity::frequency},
        Case{"2 kN s/m", 2000.0, Quantity::damping}, Case{"0.5 rad", 0.5, Quantity::angle},
        Case{"3 m/s", 3.0, Quantity::velocity}, Case{"2 N m", 2.0, Quantity::energy},
        Case{"4 s-1", 4.0, Quantity::rate}, Case{"inf", std::numeric_limits<double>::infinity(), Quantity::number}}) {
    EXPECT_EQ(read(text).value, value) << text;
    EXPECT_EQ(read(text).quantity, quantity) << text;
  }
  EXPECT_NEAR(read("2*pi rad/s").value, 1.0, 1e-15);  // Hz, but for the rounding of 2 pi
  EXPECT_EQ(read("2*pi rad/s").unit, "rad/s");
}

TEST(Reading, of_every_quantity_is_in_the_unit_that_files_have) {
  for (const std::string_view unit : {"rad", "m", "s", "Hz", "s-1", "m s-1", "kg", "N", "N m-1", "N s m-1", "N s"})
    EXPECT_EQ(si_unit(read("3 " + std::string(unit)).quantity), unit);
  EXPECT_EQ(quantity_in("m s-1"), Quantity::velocity);
  EXPECT_EQ(quantity_in("1"), Quantity::number);
  EXPECT_EQ(quantity_in("furlong"), std::nullopt);
}

TEST(Reading, is_refused_where_its_unit_does_not_fit) {
  EXPECT_EQ(in_unit_of_file(read("1.5 mm"), "m", {}, ""), 0.0015);
  EXPECT_EQ(in_unit_of_file(read("1.5"), "m", {}, ""), 1.5);
  EXPECT_EQ(refusal("3 Hz"), "--where gap: the unit 'Hz' doesn't fit: 'gap' in 'a.h5' is in m");
  EXPECT_EQ(refusal("3 mm", "1"),
            "--where gap: the unit 'mm' doesn't fit: 'gap' in 'a.h5' has none; give the number alone");
  EXPECT_EQ(refusal("3 foo"), "--where: unknown unit 'foo'; `clatter help units` explains units");
  EXPECT_EQ(refusal("3 m3"), "--where: the unit 'm3' is that of nothing that clatter computes");
  EXPECT_EQ(refusal("mm"), "--where: expected a number, such as 0.5 or 2*pi, found 'mm'");
}

}  // namespace
}  // namespace clatter::config::reading_test
