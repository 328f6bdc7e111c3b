#include "config/wrong_table.hpp"
#include "sweep/sweep.hpp"

namespace clatter::config::loose_mass_test {
namespace {

const std::string carried = "[scene]\nf = 1\nloose_mass = 0.1\nloose_gap = 2\n";

TEST(LooseMass, needs_its_keys_together) {
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\nloose_gap = 2\n", "3:1", "'loose_gap' without 'loose_mass'; give that, or leave it out"},
      {"[scene]\nxs = 1\n[sweep]\nloose_R = [1, 0.5]\n", "4:1", "'loose_R' without 'loose_mass'"},
      {"[scene]\nf = 1\nloose_mass = 0.1\n", "3:1", "'loose_mass' without walls"},
      {"[scene]\nf = 1\nloose_mass = 0.1\nloose_lower = -inf\n", "3:1", "give loose_gap, loose_lower or loose_upper"},
      {"[scene]\nf = 1\nloose_mass = -0.1\nloose_gap = 2\n", "3:14",
       "loose_mass = -0.1 is out of range; expected >= 0"},
      {carried + "loose_lower = -1\n", "5:1", "'loose_lower' conflicts with 'loose_gap'"},
      {"[scene]\nf = 1\nloose_mass = 0.1\nloose_lower = 3\nloose_upper = 2\n", "4:15",
       "expected loose_lower < loose_upper"},
      {carried + "loose_x0 = 3\n", "5:12", "expected a start between the walls, -loose_gap <= loose_x0 <= loose_gap"},
      {"[scene]\nf = 1\nloose_mass = 0.1\nloose_lower = 1\n", "4:15", "expected a start between the walls"},
  };
  expect_all("a.toml", table);
}

TEST(LooseMass, lies_on_a_mass_with_a_spring_alone) {
  const std::vector<Wrong> table{
      {carried + "xs = 1\n", "5:6", "'xs' conflicts with 'loose_mass'; leave it out: the walls of a loose mass"},
      {carried + "stop_upper = 1\n", "5:14", "'stop_upper' conflicts with 'loose_mass'"},
      {carried + "friction = 0.1\n", "5:12", "'friction' conflicts with 'loose_mass'; leave out one of them"},
      {carried + "stop_amplitude = 0.1\n", "5:18", "give base_amplitude, whose base carries the spring"},
      {carried + "stiffness = 0\n", "5:13", "a stiffness that is not above 0 conflicts with 'loose_mass'"},
      {carried + "start_period = 3\n", "5:1", "'start_period' conflicts with 'loose_mass'; give x0 and v0 instead"},
      {"[machine]\nmass = 1\nloose_mass = 0.1\nloose_gap = 2\n", "1:2", "'loose_mass' on a mass without a spring"},
  };
  expect_all("a.toml", table);
}

TEST(LooseMass, is_refused_by_what_does_not_know_it) {
  const std::vector<Wrong> table{
      {"[scene]\nloose_mass = 0.1\nloose_gap = 2\n", "2:1",
       "steady motion without a force conflicts with 'loose_mass'"},
      {"[scene]\nloose_mass = 0.1\nloose_gap = 2\n[sweep]\nf = [1, 0]\n", "5:9", "give f or base_amplitude"},
      {carried + "[observe]\nsensitivity = \"R\"\n", "6:15", "names 'R', which conflicts with 'loose_mass'"},
      {carried + "[observe]\nsensitivity = \"loose_v0\"\n", "6:15", "'loose_v0', a start"},
      {carried + "[sweep]\nloose_x0 = [0, 1]\nfollow = \"loose_x0\"\n", "7:10", "only the first point would start"},
      {carried + "[branch]\nalong = \"R\"\nrange = [0.5, 1]\n", "6:9", "along = 'R' conflicts with 'loose_mass'"},
      {carried + "[branch]\nalong = \"loose_mass\"\nrange = [0, 1]\n", "7:9", "range of 'loose_mass' reaches 0"},
      {carried + "[branch]\nalong = \"nu\"\nrange = [0.5, 2]\nacross = \"f\"\ncurve = \"fold\"\n", "8:1",
       "'across' conflicts with 'loose_mass'"},
      {"[scene]\nloose_mass = 0.1\nloose_gap = 2\n[time]\nmode = \"transient\"\nduration = 9\n[observe]\nsection = 4\n",
       "8:1", "a section without a force conflicts with 'loose_mass'"},
  };
  expect_all("a.toml", table);
}

TEST(LooseMass, is_read_in_both_sections) {
  const Config scene = parse_config(carried + "loose_load = -0.5\nloose_R = 0.5\nloose_x0 = 1\nloose_v0 = 2\n", "a");
  const LooseMass& loose = problem_at(scene.sweep, 0).loose;
  EXPECT_EQ(loose, (LooseMass{0.1, -2, 2, 0.5, -0.5, 1, 2}));
  const Config machine = parse_config(
      "[machine]\nmass = 0.5\nstiffness = 32\nforce = 1\nfrequency = 2\nloose_mass = \"50 g\"\nloose_lower = \"-3 "
      "mm\"\n"
      "loose_load = \"-16 m/s2\"\nloose_v0 = 4\n",
      "a");
  const LooseMass& of_machine = problem_at(machine.sweep, 0).loose;
  EXPECT_EQ(of_machine.ratio, 0.1);
  EXPECT_EQ(of_machine.lower, -0.003);
  EXPECT_TRUE(std::isinf(of_machine.upper));
  EXPECT_EQ(of_machine.load, -0.25);  // a unit of time is 1/8 s
  EXPECT_EQ(of_machine.velocity, 0.5);
}

/// The complete text is the scene again; without a loose mass none of its keys is in it.
TEST(LooseMass, is_in_the_complete_text_only_if_there_is_one) {
  const Config config = parse_config(carried, "a");
  EXPECT_NE(config.text.find("loose_gap = 2.0\nloose_R = 1.0\nloose_load = 0.0\nloose_x0 = 0.0\nloose_v0 = 0.0\n"),
            std::string::npos);
  EXPECT_EQ(parse_config(config.text, "b").text, config.text);
  EXPECT_EQ(parse_config("[scene]\nxs = 1\n", "a").text.find("loose"), std::string::npos);
}

}  // namespace
}  // namespace clatter::config::loose_mass_test
