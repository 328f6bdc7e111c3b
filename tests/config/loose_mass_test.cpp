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

TEST(LooseMass, is_on_a_mass_with_stops_friction_and_any_spring) {
  const auto problem = [](const std::string& more) { return problem_at(parse_config(carried + more, "a").sweep, 0); };
  const Scene stopped = problem("stop_upper = 1\nfriction = 0.1\nstiffness = -1\n[observe]\nword = true\n");
  EXPECT_EQ(stopped.stops.upper, 1);
  EXPECT_EQ(stopped.friction.kinetic, 0.1);
  EXPECT_EQ(stopped.oscillator.stiffness, -1);
  EXPECT_EQ(stopped.loose.ratio, 0.1);
  for (const std::string own : {"xs = 1\n", "stop_upper = 1\nstop_stiffness = 9\n", "friction = 0.1\n"}) {
    const auto observed = problem(own).observe;
    EXPECT_TRUE(observed.wall_impacts && observed.wall_log && observed.word_walls && !observed.loose_impacts) << own;
  }
  for (const std::string none : {"", "stop_upper = inf\n", "friction = 0\n", "stiffness = 0\n"})
    EXPECT_TRUE(problem(none).observe.loose_impacts && !problem(none).observe.wall_log) << none;
}

TEST(LooseMass, is_on_a_mass_that_is_not_shaken_beside_stops) {
  const std::vector<Wrong> table{
      {carried + "stop_amplitude = 0.1\n", "5:18", "give base_amplitude, whose base carries the spring"},
      {carried + "start_period = 3\n", "5:1", "'start_period' conflicts with 'loose_mass'; give x0 and v0 instead"},
      {carried + "base_amplitude = 0.1\nxs = 1\n", "6:6", "a stop of the main mass conflicts with 'base_amplitude'"},
      {carried + "base_amplitude = 0.1\nfriction = 1\n", "6:12", "leave one of the three out"},
      {carried + "xs = 1\nx0 = 2\n", "6:6", "expected a start between the stops"},
  };
  expect_all("a.toml", table);
}

TEST(LooseMass, is_refused_by_what_does_not_know_it) {
  const std::vector<Wrong> table{
      {carried + "[observe]\nsensitivity = \"R\"\n", "6:15", "names 'R', which conflicts with 'loose_mass'"},
      {carried + "[observe]\nsensitivity = \"loose_v0\"\n", "6:15", "'loose_v0', a start"},
      {carried + "[sweep]\nloose_x0 = [0, 1]\nfollow = \"loose_x0\"\n", "7:10", "only the first point would start"},
      {carried + "xs = 1\n[observe]\nsensitivity = \"base_amplitude\"\n", "7:15",
       "names 'base_amplitude', which conflicts with 'loose_mass'"},
      {carried + "friction = 0.1\n[branch]\nalong = \"nu\"\nrange = [0.5, 2]\n", "5:12",
       "friction of the main mass conflicts with [branch] beside 'loose_mass'"},
      {carried + "[branch]\nalong = \"R\"\nrange = [0.5, 1]\n", "6:9", "the main mass has no stop"},
      {carried + "xs = 1\n[branch]\nalong = \"stop_amplitude\"\nrange = [0.5, 1]\n", "7:9",
       "along = 'stop_amplitude' conflicts with 'loose_mass'"},
      {carried + "[branch]\nalong = \"stiffness\"\nrange = [-0.5, 1]\n", "7:9", "range of 'stiffness' reaches 0"},
      {carried + "[branch]\nalong = \"loose_mass\"\nrange = [0, 1]\n", "7:9", "range of 'loose_mass' reaches 0"},
      {carried + "[branch]\nalong = \"nu\"\nrange = [0.5, 2]\nacross = \"loose_mass\"\nacross_range = [0, 1]\ncurve = "
                 "\"fold\"\n",
       "9:16", "range of 'loose_mass' reaches 0"},
  };
  expect_all("a.toml", table);
}

TEST(LooseMass, rubs_on_its_housing_only_where_that_is_known) {
  const std::string rubbing = carried + "loose_friction = 0.01\n";
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\nloose_friction = 0.1\n", "3:1", "'loose_friction' without 'loose_mass'"},
      {carried + "loose_friction = -1\n", "5:18", "loose_friction = -1 is out of range; expected >= 0"},
      {rubbing + "loose_friction_static = 0.005\n", "5:18", "expected loose_friction <= loose_friction_static"},
      {rubbing + "[observe]\nsensitivity = \"loose_friction_static\"\n", "7:15",
       "which isn't given, so that it follows 'loose_friction'"},
      {rubbing + "[branch]\nalong = \"nu\"\nrange = [0.5, 2]\n", "5:18", "conflicts with [branch]"},
      {carried + "loose_friction_static = 0.1\n[branch]\nalong = \"nu\"\nrange = [0.5, 2]\n", "5:25",
       "friction of the loose mass conflicts with [branch]"},
      {carried + "[observe]\nsensitivity = \"loose_friction\"\n", "6:15", "names 'loose_friction', which conflicts"},
      {carried + "[branch]\nalong = \"loose_friction\"\nrange = [0, 1]\n", "6:9", "loose_friction"},
  };
  expect_all("a.toml", table);
  const std::string observed = "[observe]\nstability = true\nattractor = true\nenergy = true\n";
  EXPECT_FALSE(problem_at(parse_config(carried + "loose_friction = 0\n" + observed, "a").sweep, 0).observe.of_friction);
  const auto observe = problem_at(parse_config(rubbing + observed, "a").sweep, 0).observe;
  EXPECT_TRUE(observe.of_friction && !observe.of_sticks && observe.loose_impacts);
}

TEST(LooseMass, has_friction_in_the_unit_of_the_force) {
  const LooseMass loose =
      problem_at(parse_config(carried + "stiffness = 4\nloose_friction = 0.02\n", "a").sweep, 0).loose;
  EXPECT_EQ(loose.friction, 0.005);  // in units of k = 1
  EXPECT_EQ(loose.friction_static, 0.005);
  const LooseMass of_machine =
      problem_at(parse_config("[machine]\nmass = 0.5\nstiffness = 32\nforce = 1\nfrequency = 2\nloose_mass = \"50 g\"\n"
                              "loose_gap = \"3 mm\"\nloose_friction = \"16 mN\"\nloose_friction_static = \"32 mN\"\n",
                              "a")
                     .sweep,
                 0)
          .loose;
  EXPECT_EQ(of_machine.friction, 0.016 / 32);
  EXPECT_EQ(of_machine.friction_static, 0.032 / 32);
}

TEST(LooseMass, is_read_in_both_sections) {
  const Config scene = parse_config(carried + "loose_load = -0.5\nloose_R = 0.5\nloose_x0 = 1\nloose_v0 = 2\n", "a");
  const LooseMass& loose = problem_at(scene.sweep, 0).loose;
  EXPECT_EQ(loose, (LooseMass{.ratio = 0.1,
                              .lower = -2,
                              .upper = 2,
                              .restitution_lower = 0.5,
                              .restitution_upper = 0.5,
                              .load = -0.5,
                              .place = 1,
                              .velocity = 2}));
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
  EXPECT_NE(
      config.text.find(
          "loose_gap = 2.0\nloose_R = 1.0\nloose_load = 0.0\nloose_friction = 0.0\nloose_x0 = 0.0\nloose_v0 = 0.0\n"),
      std::string::npos);
  EXPECT_EQ(parse_config(config.text, "b").text, config.text);
  const std::string beside = parse_config(carried + "stop_upper = 1\nfriction = 0.1\n", "a").text;
  EXPECT_EQ(parse_config(beside, "b").text, beside);
  EXPECT_EQ(parse_config("[scene]\nxs = 1\n", "a").text.find("loose"), std::string::npos);
}

}  // namespace
}  // namespace clatter::config::loose_mass_test
