#include "config/value_grammar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace clatter::config::value_grammar_test {
namespace {

using std::numbers::pi;

double number(std::string_view text) { return parse_number({text, {"f", 1, 1}, true}); }
std::vector<double> axis(std::string_view text) { return parse_axis({text, {"f", 1, 1}, true}).values; }

/// The mistake in an axis, with the column at which it is found.
std::string mistake(std::string_view text) {
  try {
    (void)parse_axis({text, {"f", 1, 1}, true});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

TEST(Number, is_read_as_it_is_written) {
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("+5"), 5);
  EXPECT_EQ(number("-1e-3"), -1e-3);
  EXPECT_EQ(number(" .5 "), 0.5);
  EXPECT_EQ(number("inf"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(number("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::signbit(number("-0")));
}

TEST(Number, pi_stands_as_a_number_or_a_factor) {
  EXPECT_EQ(number("pi"), pi);
  EXPECT_EQ(number("-pi"), -pi);
  EXPECT_EQ(number("2*pi"), 2 * pi);
  EXPECT_EQ(number("pi * 0.5"), pi * 0.5);
  EXPECT_EQ(number("-2*pi/3"), -2 * pi / 3);
}

TEST(Number, reads_back_from_its_shortest_text) {
  for (const double value : {0.1, 1.0 / 3, 1e300, -5e-324, 1e22, 4.9e-300, 12345678901234567890.0, -0.0, 1.0}) {
    EXPECT_EQ(number(number_text(value)), value) << number_text(value);
    EXPECT_EQ(number(toml_number(value)), value) << toml_number(value);
  }
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(toml_number(-1), "-1.0");  // an integer in TOML loses the sign of -0, and ends at 2^63
}

TEST(Linspace, has_equal_steps_and_both_ends) {
  const auto values = axis("linspace(0.5, 1.5, 501)");
  ASSERT_EQ(values.size(), 501u);
  for (std::size_t i = 0; i < 500; ++i) EXPECT_EQ(values[i], 0.5 + static_cast<double>(i) * (1.5 - 0.5) / 500);
  EXPECT_EQ(values.back(), 1.5);
  EXPECT_EQ(axis("linspace(0, 0.3, 4)").back(), 0.3);  // 3 * 0.1 is not 0.3: the last one is given, not computed
  EXPECT_EQ(axis("linspace(1.5, 0.5, 3)"), (std::vector{1.5, 1.0, 0.5}));
  EXPECT_EQ(axis("linspace(2, 3, 1)"), std::vector{2.0});
  EXPECT_EQ(axis("linspace(0, 2*pi, 2)"), (std::vector{0.0, 2 * pi}));
}

TEST(Logspace, has_equal_ratios_and_both_ends) {
  EXPECT_EQ(axis("logspace(1, 1000, 4)"), (std::vector{1.0, 10.0, 100.0, 1000.0}));
  EXPECT_EQ(axis("logspace(-8, -1, 4)"), (std::vector{-8.0, -4.0, -2.0, -1.0}));
  EXPECT_EQ(axis("logspace(0.1, 0.3, 7)").front(), 0.1);
  EXPECT_EQ(axis("logspace(0.1, 0.3, 7)").back(), 0.3);
  const auto wide = axis("logspace(1e-300, 1e300, 3)");  // the ratio itself is beyond double precision
  EXPECT_NEAR(wide[1], 1.0, 1e-15);
}

TEST(Arange, excludes_its_end_even_if_rounding_would_not) {
  EXPECT_TRUE(std::signbit(axis("arange(-0, 1, 0.1)").front()));
  EXPECT_EQ(axis("arange(0, 1, 0.25)"), (std::vector{0.0, 0.25, 0.5, 0.75}));
  EXPECT_EQ(axis("arange(1, 1.3, 0.1)").size(), 3u);  // (1.3 - 1)/0.1 = 3.0000000000000004
  EXPECT_EQ(axis("arange(0, 0.3, 0.1)").size(), 3u);  // (0.3 - 0)/0.1 = 2.9999999999999996
  EXPECT_EQ(axis("arange(3, 0, -1)"), (std::vector{3.0, 2.0, 1.0}));
  EXPECT_EQ(axis("arange(0, 1, 5)"), std::vector{0.0});
}

TEST(List, takes_numbers_with_or_without_brackets) {
  EXPECT_EQ(axis("1, 2, 3"), (std::vector{1.0, 2.0, 3.0}));
  EXPECT_EQ(axis("[ 1,2 , -pi ]"), (std::vector{1.0, 2.0, -pi}));
  EXPECT_EQ(axis("0.5"), std::vector{0.5});
  EXPECT_EQ(axis("-inf, 1"), (std::vector{-std::numeric_limits<double>::infinity(), 1.0}));
}

TEST(Axis, keeps_its_expression_in_one_form) {
  EXPECT_EQ(parse_axis({"linspace( 0.50,1.5 , 501 )", {}, false}).text, "\"linspace(0.5, 1.5, 501)\"");
  EXPECT_EQ(parse_axis({"1,2.50", {}, false}).text, "[1.0, 2.5]");
}

TEST(Mistake, is_found_at_its_column) {
  const std::vector<std::pair<const char*, const char*>> mistakes{
      {"", "f:1:1: an empty axis"},
      {"[]", "f:1:1: an empty axis"},
      {"1, x", "f:1:4: expected a number"},
      {"1, 2,", "f:1:6: expected a number, such as 0.5 or 2*pi, found the end of the value"},
      {"1 2", "f:1:3: expected the end of the value, found '2'"},
      {"[1, 2", "f:1:6: expected ',' or ']'"},
      {"1, 2]", "f:1:5: expected the end of the value, found ']'"},
      {"--1", "f:1:1: expected a number, found two signs"},
      {"0x10", "f:1:2: expected the end of the value, found 'x10'"},
      {"2pi", "f:1:2: expected the end of the value, found 'pi'"},
      {"1e999", "f:1:1: '1e999' is beyond the range of double precision"},
      {"linspce(0, 1, 2)", "f:1:1: unknown function 'linspce'; did you mean 'linspace'?"},
      {"sin(1)", "f:1:1: unknown function 'sin'; expected one of linspace, logspace, arange, sobol"},
      {"linspace(0, 1)", "f:1:14: expected ',' in linspace(a, b, n), found ')'"},
      {"linspace(0, 1, 2, 3)", "f:1:17: expected ')' after the three arguments of linspace(a, b, n)"},
      {"linspace(0, 1, 2", "f:1:17: expected ')'"},
      {"linspace(0, 1, 2) 3", "f:1:19: expected the end of the value, found '3'"},
      {"linspace(0, 1, 2.5)", "f:1:1: n = 2.5 values; expected a whole number from 1"},
      {"linspace(0, 1, 0)", "n = 0 values; expected a whole number from 1"},
      {"linspace(0, 1, -3)", "n = -3 values; expected a whole number from 1"},
      {"linspace(0, 1, 1e9)", "1e+09 values; expected at most 1e+07"},
      {"linspace(0, inf, 3)", "not finite"},
      {"linspace(-1e308, 1e308, 3)", "more than double precision holds"},
      {"logspace(-1, 1, 3)", "expected two ends of the same sign, neither of them 0"},
      {"logspace(0, 1, 3)", "expected two ends of the same sign, neither of them 0"},
      {"arange(0, 1, 0)", "a step of 0"},
      {"sobol(0, 1)", "f:1:11: expected ',' in sobol(a, b, n), found ')'"},
      {"sobol(0, 1, 0)", "n = 0 values; expected a whole number from 1"},
      {"sobol(0, inf, 3)", "not finite"},
      {"sobol(-1e308, 1e308, 3)", "more than double precision holds"},
      {"arange(0, 1, -1)", "an empty axis"},
      {"arange(1, 1, 0.1)", "an empty axis"},
      {"arange(0, 1, 1e-12)", "expected at most 1e+07"},
      {"linspace(0, 1, nan)", "not finite"},
  };
  for (const auto& [text, expected] : mistakes)
    EXPECT_NE(mistake(text).find(expected), std::string::npos) << text << " gave " << mistake(text);
}

}  // namespace
}  // namespace clatter::config::value_grammar_test
