#include "observables/drawn_names.hpp"

#include <gtest/gtest.h>

#include <string>

#include "observables/all.hpp"
#include "scene/parameter.hpp"

namespace clatter::observables::drawn_names_test {
namespace {

bool is_named(std::string_view variable, bool is_si) {
  const DrawnName name = drawn_name(variable, is_si);
  return !name.words.empty() || !name.symbol.empty();
}

TEST(DrawnNames, every_parameter_has_one_in_its_section) {
  for (const Parameter parameter : all_parameters)
    for (const bool is_si : {false, true})
      EXPECT_EQ(is_named(parameter.key(), is_si) || !parameter.is_in(is_si ? "machine" : "scene"), true)
          << parameter.key() << is_si;
}

TEST(DrawnNames, symbols_are_whole_TeX) {
  for (const Parameter parameter : all_parameters) {
    const std::string symbol = drawn_name(parameter.key(), false).symbol;
    EXPECT_EQ(std::ranges::count(symbol, '$') % 2, 0) << symbol;
    EXPECT_EQ(std::ranges::count(symbol, '{'), std::ranges::count(symbol, '}')) << symbol;
  }
}

TEST(DrawnNames, a_key_of_a_machine_is_its_own_symbol_unless_the_equation_has_a_letter_for_it) {
  EXPECT_EQ(drawn_name("gap", true).symbol, "gap");
  EXPECT_EQ(drawn_name("mass", true).symbol, "$m$");
  EXPECT_EQ(drawn_name("xs", false).symbol, "$x_s$");
  EXPECT_FALSE(is_named("no_such_variable", true));
}

TEST(DrawnNames, a_derivative_has_the_symbols_of_its_result_and_its_key) {
  EXPECT_EQ(drawn_name("d_x_max_d_stop_upper", false).symbol, "∂$x_{\\max}$/∂$x_+$");
  EXPECT_EQ(drawn_name("d_x_max_d_stop_upper", true).symbol, "∂$x_{\\max}$/∂stop_upper");
  EXPECT_EQ(drawn_name("d_impact_power_d_mass", true).symbol, "∂impact_power/∂$m$");
}

TEST(DrawnNames, constants_of_a_scene_are_lines_of_TOML_with_their_units) {
  const std::string scene = scene_names(false), machine = scene_names(true);
  EXPECT_NE(scene.find("h = { units = '1', words = 'damping ratio', symbol = '$h$' }\n"), std::string::npos) << scene;
  EXPECT_EQ(scene.find("mass = "), std::string::npos);
  EXPECT_NE(machine.find("mass = { units = 'kg', words = 'mass', symbol = '$m$' }\n"), std::string::npos) << machine;
  EXPECT_EQ(machine.find("\nxs = "), std::string::npos);
}

}  // namespace
}  // namespace clatter::observables::drawn_names_test
