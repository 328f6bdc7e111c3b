#include "config/suggestion.hpp"

#include "config/wrong_table.hpp"

namespace clatter::config::suggestion_test {
namespace {

TEST(Comma, in_a_number_is_told_from_a_list) {
  EXPECT_EQ(comma_hint("0,1"), "; a decimal comma? write 0.1");
  EXPECT_EQ(comma_hint(" -2,5e-3 "), "; a decimal comma? write -2.5e-3");
  EXPECT_EQ(comma_hint("-0,5*pi"), "; a decimal comma? write -0.5*pi");
  for (const char* list : {"0.1,0.2", "0, 1", "0 ,1", "1,2,3", "[0,1]", ",1", "1,", ",", "", "0.5", "pi,2", "f(0,1)"})
    EXPECT_EQ(comma_hint(list), "") << list;
}

TEST(Comma, before_three_digits_may_be_of_thousands) {
  EXPECT_EQ(comma_hint("2,000 N/m"), "; a decimal comma? write 2.000 N/m; thousands? write 2000 N/m");
  EXPECT_EQ(comma_hint("-12,000"), "; a decimal comma? write -12.000; thousands? write -12000");
  EXPECT_EQ(comma_hint("1,200,000 N/m"), "; thousands? write 1200000 N/m");
  for (const char* decimal : {"0,100", "2,00", "2,0000", "1234,000"})
    EXPECT_EQ(comma_hint(decimal).find("thousands"), std::string::npos) << decimal;
}

TEST(Comma, between_thousands_of_a_whole_number_is_left_out) {
  EXPECT_EQ(comma_hint("10,000", Kind::integer), "; write it without commas: 10000");
  EXPECT_EQ(comma_hint("1,000,000", Kind::integer), "; write it without commas: 1000000");
  EXPECT_EQ(comma_hint("10,5", Kind::integer), "; a decimal comma? write 10.5");
  EXPECT_EQ(comma_hint("10,0000,000", Kind::integer), "");
}

TEST(Comma, decimal_is_named_in_the_error) {
  expect_all("a.toml", {
                           {"[scene]\nh = 0,1\n", "2:6", "saw ','; a decimal comma? write 0.1"},
                           {"[scene]\nh = -0,1*pi # b\n", "2:7", "; a decimal comma? write -0.1*pi"},
                           {"title = \"ä, b = 1\"\n[scene]\nh=0,1", "3:4", "; a decimal comma? write 0.1"},
                           {"[scene]\nh = \"0,1\"\n", "2:5", "expected >= 0; a decimal comma? write 0.1"},
                           {"[time]\nmax_periods = 10,000\n", "2:17", "; write it without commas: 10000"},
                       });
  expect_all("a.ini",
             {
                 {"[scene]\nh = 0,1\n", "2:5",
                  "h = the text '0,1'; expected >= 0; a decimal comma? write 0.1; several values are an axis, "
                  "and its line belongs in [sweep]"},
                 {"[time]\ntolerance = 1,5e-9\n", "2:13", "; a decimal comma? write 1.5e-9"},
                 {"[time]\nmax_periods = 10,000\n", "2:15", "; write it without commas: 10000"},
                 {"[sweep]\nnu = 0,5\n", "2:6", "nu = 0 is out of range; expected > 0; a decimal comma?"},
                 {"[sweep]\nnu = linspace(0,5, 1,5, 501)\n", "2:21",
                  "after the three arguments of linspace(a, b, n), found ',5, 501)'; a decimal comma? write 0.5"},
             });
  EXPECT_EQ(mistake_in("a.toml", "", {{"scene.h", "0,1"}}),
            "--set scene.h=0,1: h = the text '0,1'; expected >= 0; a decimal comma? write 0.1; several values are an "
            "axis: --set sweep.h='0,1'");
}

TEST(Axis, in_the_scene_is_told_where_it_belongs) {
  const std::string home = "several values are an axis, and its line belongs in [sweep]";
  for (const std::string value :
       {"[0.05, 0.1]", "\"linspace(0, 1, 3)\"", "\"[0.05, 0.1]\"", "\"0.05, 0.1\"", "[0.1]"}) {
    expect_all("a.toml", {{"[scene]\nxs = 1\nh = " + value + "\n", "3:5", home}});
    expect_all("a.ini", {{"[scene]\nxs = 1\nh = " + value + "\n", "3:5", home}});
  }
  for (const std::string value : {"0.05, 0.1", "linspace(0, 1, 3)", "arange(0,1,0.1)"})
    expect_all("a.ini", {{"[scene]\nxs = 1\nh = " + value + "\n", "3:5", home}});
  expect_all("a.toml", {{"[scene]\nh = 0.05, 0.1\n", "2:9",
                         "; several values are an axis, in brackets and in [sweep]: nu = [0.8, 1.2]"}});
  EXPECT_EQ(mistake_in("a.toml", "", {{"scene.h", "[0.05, 0.1]"}}),
            "--set scene.h=[0.05, 0.1]: h = the text '[0.05, 0.1]'; expected >= 0; several values are an axis: --set "
            "sweep.h='[0.05, 0.1]'");
}

TEST(Axis, of_another_section_is_none) {
  const std::string words = "one value, since only keys of [scene] or [machine] can be axes";
  expect_all("a.toml", {{"[time]\nwindow = [1, 2]\n", "2:10", words}});
  expect_all("a.ini", {{"[time]\nwindow = 1, 2\n", "2:10", words}, {"[integrator]\nstep = [1]\n", "2:8", words}});
}

}  // namespace
}  // namespace clatter::config::suggestion_test
