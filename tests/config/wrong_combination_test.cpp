#include "config/wrong_table.hpp"

namespace clatter::config::wrong_combination_test {
namespace {

const std::string both = "[scene]\nxs = 1\n[sweep]\nnu = [1, 2]\n";

TEST(Together, alternatives_exclude_each_other) {
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\nstop_lower = -1\n", "3:1", "'stop_lower' conflicts with 'xs'"},
      {"[scene]\nstop_lower = -1\nstop_upper = 1\nxs = 1\n", "4:1", "'xs' conflicts with 'stop_lower'"},
      {both + "stop_upper = [1]\n", "5:1", "'stop_upper' conflicts with 'xs'"},
      {"[scene]\nxs = 1\nR = 1\nR_lower = 1\n", "4:1", "'R_lower' conflicts with 'R'"},
      {"[scene]\nxs = 1\nR_upper = 1\n[sweep]\nR = [1]\n", "5:1", "'R' conflicts with 'R_upper'"},
      {"[scene]\nxs = 1\nstart_period = 3\nx0 = 0\n", "4:1", "'x0' conflicts with 'start_period'"},
      {"[scene]\nxs = 1\nv0 = 1\n[sweep]\nstart_period = [3]\n", "5:1", "'start_period' conflicts with 'v0'"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, something_has_to_bound_the_motion) {
  const std::vector<Wrong> table{
      {"[scene]\nstiffness = -1\nstop_lower = -inf\n", "2:13", "stiffness = -1 without stops, so nothing bounds"},
      {"[scene]\nstiffness = 0\nstop_upper = inf\n", "2:13", "give xs, stop_lower or stop_upper, or a stiffness > 0"},
      {"[scene]\nstop_upper = inf\n[sweep]\nstiffness = [1, 0]\n", "4:17", "stiffness = 0 without stops"},
      {"[scene]\nxs = 1\nstiffness = 2\nstart_period = 3\n", "3:13", "stiffness = 2 conflicts with 'start_period'"},
  };
  expect_all("a.toml", table);
}

TEST(Together, a_soft_stop_has_no_restitution_and_holds_the_mass) {
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\nR = 0.5\nstop_stiffness = 10\n", "4:1", "'stop_stiffness' conflicts with 'R'"},
      {"[scene]\nxs = 1\nstop_stiffness_upper = 10\nR_upper = 0.5\n", "4:1", "conflicts with 'stop_stiffness_upper'"},
      {"[scene]\nxs = 1\nR = 0.5\n[sweep]\nstop_stiffness = [10, inf]\n", "5:1", "remove one of them"},
      {"[scene]\nxs = 1\nstop_stiffness = 0\n", "3:18", "stop_stiffness = 0 is out of range; expected > 0 or inf"},
      {"[scene]\nxs = 1\nstop_stiffness = -inf\n", "3:18", "expected > 0 or inf"},
      {"[scene]\nxs = 1\nstop_stiffness = nan\n", "3:18", "stop_stiffness"},
      {"[scene]\nxs = 1\nstop_stiffness = 1\nstop_damping = -1\n", "4:16", "expected >= 0"},
      {"[scene]\nxs = 1\nstiffness = -3\nstop_stiffness = 3\n", "4:18", "expected more than 3"},
      {"[scene]\nxs = 1\nstop_stiffness_lower = 2\n[sweep]\nstiffness = [1, -2.5]\n", "3:24", "expected more than 2.5"},
      {"[scene]\nxs = 1\nstop_stiffness = 3\nstart_period = 3\n", "3:18", "conflicts with 'start_period'"},
      {"[scene]\nxs = 1\n[sweep]\nstiffness = [-5, 1]\nstop_stiffness = [100, 0.5]\n", "5:24", "expected more than 5"},
      {"[scene]\nxs = 1\n[sweep]\nstiffness = [1, -5]\nstop_stiffness = [9, 4]\nlinked = \"stiffness, "
       "stop_stiffness\"\n",
       "5:22", "stop_stiffness = 4 holds no mass that stiffness = -5 pushes away"},
  };
  expect_all("a.toml", table);
}

TEST(Together, a_soft_stop_is_damped_in_one_way) {
  const std::string soft = "[scene]\nxs = 1\nstop_stiffness = 10\n", one = "[scene]\nstop_upper = 1\n";
  const std::vector<Wrong> table{
      {soft + "stop_damping = 0.1\nstop_R = 0.7\n", "5:1", "'stop_R' conflicts with 'stop_damping'; remove one"},
      {soft + "stop_R = 0.7\nstop_damping_lower = 0.1\n", "5:1", "'stop_damping_lower' conflicts with 'stop_R'"},
      {soft + "stop_damping = 0.1\n[sweep]\nstop_R_upper = [0.7, 1]\n", "6:1", "conflicts with 'stop_damping'"},
      {soft + "stop_R = 0.7\nstop_R_upper = 0.1\n", "5:1", "'stop_R_upper' conflicts with 'stop_R'"},
      {soft + "stop_R = 0\n", "4:10", "stop_R = 0 is out of range; expected > 0 and <= 1"},
      {soft + "stop_R = 1.01\n", "4:10", "expected > 0 and <= 1"},
      {soft + "stop_R = inf\n", "4:10", "stop_R = inf is not finite; expected > 0 and <= 1"},
      {"[scene]\nxs = 1\nstop_R = 0.7\n", "3:1",
       "'stop_R' is of a soft stop, and the lower one is rigid; give 'R', or"},
      {"[scene]\nxs = 1\nstop_stiffness_lower = 9\nstop_R_upper = 0.7\n", "4:1", "upper one is rigid; give 'R_upper'"},
      {"[scene]\nxs = 1\nstop_R = 1\n[sweep]\nstop_stiffness = [9, inf]\n", "3:1", "lower one is rigid at some points"},
      {one + "[branch]\nalong = \"stop_R\"\nrange = [0.1, 2]\n", "5:9", "range has stop_R = 2; expected > 0 and <= 1"},
      {soft + "[branch]\nalong = \"stop_R\"\nrange = [0.1, 1]\nacross = \"stop_damping_upper\"\ncurve = \"fold\"\n",
       "7:10", "'stop_damping_upper' and 'stop_R' change the same quantity"},
  };
  expect_all("a.toml", table);
}

TEST(Together, stops_may_be_damped_in_different_ways) {
  const std::string soft = "[scene]\nxs = 1\nstop_stiffness = 10\nstop_damping_lower = 0.3\nstop_R_upper = 0.5\n";
  const Stops stops = computed(read_as("a.toml", soft).sweep.problem).stops;
  EXPECT_EQ(stops.damping_lower, 0.3);
  EXPECT_EQ(stops.damping_upper, damping_ratio_of(0.5));
  const std::string one = "[scene]\nstop_upper = 1\nstop_stiffness_upper = 10\nstop_R = 0.5\n";  // there is no other
  EXPECT_EQ(computed(read_as("a.toml", one).sweep.problem).stops.damping_upper, damping_ratio_of(0.5));
}

TEST(Together, values_that_run_together_are_compared_one_by_one) {
  const std::string axes = "[scene]\nxs = 1\n[sweep]\nstiffness = [-5, 1]\nstop_stiffness = [100, 0.5]\n";
  EXPECT_EQ(size(read_as("a.toml", axes + "linked = \"stiffness, stop_stiffness\"\n").sweep), 2U);
}

TEST(Together, one_thing_is_shaken) {
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\nstop_amplitude = 1\nbase_amplitude = 2\n", "4:18", "give one of them"},
      {"[scene]\nxs = 1\nbase_amplitude = 2\n[sweep]\nstop_amplitude = [0, 1]\n", "3:18", "give one of them"},
      {"[scene]\nxs = 1\nstop_amplitude = 1\nstart_period = 3\n", "3:18", "conflicts with 'start_period'"},
  };
  expect_all("a.toml", table);
}

TEST(Together, missing_keys_are_reported_at_their_section) {
  const std::vector<Wrong> table{
      {"", "1:1", "'xs' is missing in [scene]"},
      {"[time]\nwindow = 1\n", "1:1", "'xs' is missing in [scene]; give xs, or stop_lower, stop_upper or both"},
      {"\n [scene]\nf = 1\n", "2:3", "'xs' is missing"},
      {"[scene]\nxs = 1\n[time]\nmode = \"transient\"\n", "3:2", "'duration' is missing in [time]"},
      {"[scene]\nxs = 1\n[time]\nmode = \"transient\"\nduration = 0\n", "5:12",
       "duration = 0 is out of range; expected > 0"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, the_start_is_between_stops_in_order) {
  const std::vector<Wrong> table{
      {"[scene]\nstop_lower = 2\nstop_upper = 1\n", "2:14",
       "stop_lower = 2 and stop_upper = 1; expected stop_lower < stop_upper"},
      {"[scene]\nstop_lower = 1\nstop_upper = 1\n", "2:14", "expected stop_lower < stop_upper"},
      {"[scene]\nstop_lower = inf\n", "2:14",
       "stop_lower = inf and stop_upper = inf; expected stop_lower < stop_upper"},
      {"[scene]\nstop_upper = -inf\n", "2:14", "stop_lower = -inf and stop_upper = -inf"},
      {"[scene]\nstop_upper = -1\n", "2:14", "x0 = 0 and stop_upper = -1; expected a start between the stops"},
      {"[scene]\nx0 = -2\n[sweep]\nstop_lower = [-3, -1]\n", "2:6", "stop_lower = -1 and x0 = -2"},
      {"[scene]\nstop_lower = inf\nstop_upper = -inf\n", "2:14", "expected stop_lower < stop_upper"},
      {"[scene]\nxs = -1\nx0 = 1.5\n", "3:6",
       "x0 = 1.5 and |xs| = 1; expected a start between the stops, -|xs| <= x0 <= |xs|"},
      {"[scene]\nxs = -1\nx0 = -1.5\n", "3:6", "-|xs| = -1 and x0 = -1.5; expected a start between the stops"},
      {"[scene]\nstop_lower = 0.5\nstop_upper = 1\n", "2:14", "stop_lower = 0.5 and x0 = 0"},
      {"[scene]\nstop_lower = -2\nstop_upper = -1\n", "3:14", "x0 = 0 and stop_upper = -1"},
      {"[scene]\nx0 = 0.5\n[sweep]\nxs = [1, -0.25, 2]\n", "2:6", "x0 = 0.5 and |xs| = 0.25"},
      {"[scene]\nxs = 1\n[sweep]\nx0 = [0, 1, 2]\n", "4:13", "x0 = 2 and |xs| = 1"},
      {"[sweep]\nxs = [2, 1]\nx0 = [1, 2]\nlinked = \"xs, x0\"\n", "3:10", "x0 = 2 and |xs| = 1"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, friction_is_one_force_at_rest_and_in_motion_against_what_carries_the_mass) {
  const std::string range = "out of range; expected >= 0";
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\nfriction = -0.1\n", "3:12", "friction = -0.1 is " + range},
      {"[scene]\nxs = 1\nfriction_static = -0.1\n", "3:19", "friction_static = -0.1 is " + range},
      {"[machine]\nmass = 1\ngap = 1\nfriction = \"-2 N\"\n", "4:12", range},
      {"[scene]\nxs = 1\nfriction = 0.3\nfriction_static = 0.2\n", "3:12",
       "friction = 0.3 and friction_static = 0.2; expected friction <= friction_static"},
      {"[scene]\nxs = 1\nfriction_static = 0.2\n[sweep]\nfriction = [0.1, 0.3]\n", "5:18", "friction = 0.3 and"},
      {"[scene]\nxs = 1\n[sweep]\nlinked = \"friction, friction_static\"\nfriction = [0.1, 0.3]\n"
       "friction_static = [0.4, 0.2]\n",
       "5:18", "friction = 0.3 and friction_static = 0.2"},
      {"[scene]\nxs = 1\nfriction = 0.3\nstop_amplitude = 0.1\n", "3:12", "conflicts with 'stop_amplitude'"},
      {"[scene]\nxs = 1\nstop_amplitude = 0.1\n[sweep]\nfriction = [0, 0.1]\n", "5:16", "give base_amplitude"},
      {"[scene]\nxs = 1\nfriction = 0.3\nstart_period = 3\n", "3:12",
       "conflicts with 'start_period', which is that of motion without loss; give x0 and v0 instead"},
  };
  expect_all("a.toml", table);
}

TEST(Together, start_period_belongs_to_free_motion_between_symmetric_stops) {
  const std::string start = "[scene]\nxs = 1\nstart_period = 3\n";
  const std::vector<Wrong> table{
      {start + "h = 0.1\n", "4:5", "h = 0.1 conflicts with 'start_period'; expected 0"},
      {start + "f = 1\n", "4:5", "f = 1 conflicts with 'start_period'; expected 0"},
      {start + "load = 1\n", "4:8", "load = 1 conflicts with 'start_period'"},
      {start + "R = 0.5\n", "4:5", "R = 0.5 conflicts with 'start_period'; expected 1"},
      {start + "R_upper = 0.5\n", "4:11", "R_upper = 0.5 conflicts with 'start_period'"},
      {start + "[sweep]\nh = [0, 0.1]\n", "5:9", "h = 0.1 conflicts with 'start_period'"},
      {"[scene]\nstop_lower = -1\nstop_upper = 1\nstart_period = 3\n", "4:1", "'start_period' without 'xs'"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, axes_of_sobol_are_linked_and_in_range) {
  const std::string scene = "[scene]\nxs = 9\nf = 1\n[sweep]\n";
  const std::string crossed = scene + "x0 = \"sobol(-1, 1, 8)\"\nv0 = \"sobol(-1, 1, 8)\"\n";
  const std::vector<Wrong> table{
      {scene + "R = \"sobol(0.9, 1.2, 8)\"\n", "5:5", "R = 1.05 is out of range; expected 0 ... 1"},
      {scene + "nu = \"sobol(1, 2, 8)\"\nfollow = \"nu\"\n", "6:10",
       "follow along 'nu', whose values sobol(...) leap to and fro; write linspace(a, b, n), or follow none"},
      {crossed, "5:6", "x0 = sobol(...) without its partners, which would cross them; write linked = \"x0, v0\""},
      {crossed + "phase = \"sobol(0, 6, 8)\"\nlinked = \"x0, v0\"\n", "7:9", "write linked = \"x0, v0, phase\""},
      {crossed + "phase = \"sobol(0, 6, 9)\"\nlinked = \"x0, v0, phase\"\n", "8:10",
       "linked axes of different lengths"},
  };
  expect_all("a.toml", table);
}

TEST(Together, sensitivity_names_keys_of_steady_motion) {
  const std::string scene = "[scene]\nf = 1\nstop_upper = 1\n", machine = "[machine]\nmass = 1\ngap = 1\n";
  const auto asked = [](const std::string& by, const std::string& names) {
    return by + "[observe]\nsensitivity = \"" + names + "\"\n";
  };
  const std::vector<Wrong> table{
      {asked(scene, "R, stifness"), "5:15",
       "sensitivity names 'stifness', which is no key of [scene]; did you mean 'stiffness'?"},
      {asked(scene, "R,"), "5:15", "sensitivity names ''"},
      {asked(scene, "R, R"), "5:15", "sensitivity names 'R' twice; name each key once"},
      {asked(scene, "x0"), "5:15", "sensitivity names 'x0', a start, which steady motion doesn't depend on"},
      {asked(scene, "frequency"), "5:15", "no key of [scene], which describes this scene; take 'nu'"},
      {asked(machine, "f"), "5:15", "no key of [machine], which describes this scene; take 'force'"},
      {asked(scene, "xs"), "5:15", "the stops are given one by one; name 'stop_lower' or 'stop_upper'"},
      {asked(machine, "quality"), "5:15", "the damping isn't given by it; name 'damping' or 'damping_ratio'"},
      {asked(scene, "friction_static"), "5:15",
       "friction_static', which isn't given, so that it follows 'friction'; name that, or give it"},
      {asked(scene + "stop_amplitude = 1\n", "friction"), "6:15",
       "sensitivity names 'friction', which conflicts with 'stop_amplitude'; leave it out"},
      {asked(scene, "R") + "[time]\nmode = \"transient\"\nduration = 9\n", "5:15", "sensitivity of a transient"},
      {asked(scene, "R") + "[integrator]\nmethod = \"dopri5\"\n", "5:15",
       "sensitivity by method = 'dopri5'; only 'exact' computes it"},
  };
  expect_all("a.toml", table);
}

TEST(Together, linked_and_follow_name_axes) {
  const std::vector<Wrong> table{
      {both + "linked = \"nu\"\n", "5:10", "linked names one axis"},
      {both + "linked = \"nu, nu\"\n", "5:10", "linked names 'nu' twice"},
      {both + "linked = \"nu, g\"\n", "5:10", "linked names 'g', which is no axis of [sweep]; the axes are: nu"},
      {both + "linked = \"nu, h\"\nh = [1, 2, 3]\n", "5:10",
       "linked axes of different lengths: nu has 2 values, h has 3"},
      {both + "linked = \"nu,\"\n", "5:10", "linked names ''"},
      {both + "follow = \"nuu\"\n", "5:10", "follow names 'nuu', which is no axis of [sweep]; did you mean 'nu'?"},
      {both + "follow = \"xs\"\n", "5:10", "follow names 'xs', which is no axis of [sweep]"},
      {"[scene]\nxs = 1\n[sweep]\nfollow = \"nu\"\n", "4:10", "[sweep] has no axes"},
      {both + "follow = \"nu\"\ndirection = \"back\"\n", "6:13", "expected one of up, down, both"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, follow_takes_linked_axes_and_no_others) {
  const std::string axes = both + "h = [1, 2]\nf = [1, 2]\n";  // nu, h and f, lines 4 to 6
  const std::vector<Wrong> table{
      {axes + "follow = \"nu,rubbish\"\n", "7:10", "follow names 'rubbish', which is no axis of [sweep]"},
      {axes + "follow = \"nu, nu\"\n", "7:10", "follow names 'nu' twice; name each axis once"},
      {axes + "follow = \"nu, f\"\n", "7:10",
       "follow names 'nu' and 'f', which are not linked; follow one axis, or name both in linked too"},
      {axes + "linked = \"nu, h\"\nfollow = \"h, f\"\n", "8:10", "follow names 'h' and 'f', which are not linked"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
  EXPECT_EQ(mistake_in("a.toml", axes + "linked = \"nu, f\"\nfollow = \"f, nu\"\n"), "");
}

TEST(Together, follow_goes_along_no_start) {
  const std::vector<Wrong> table{
      {both + "phase = [0, 1]\nfollow = \"phase\"\n", "6:10",
       "follow along 'phase', which only the first point would start from; follow another axis, or none"},
      {both + "x0 = [0, 1]\nfollow = \"x0\"\n", "6:10", "follow along 'x0'"},
      {both + "v0 = [0, 1]\nlinked = \"nu, v0\"\nfollow = \"nu\"\n", "7:10", "follow along 'v0'"},
      {both + "start_period = [1, 2]\nfollow = \"start_period\"\n", "6:10", "follow along 'start_period'"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
  EXPECT_EQ(mistake_in("a.toml", both + "v0 = [0, 1]\nfollow = \"nu\"\n"), "");  // each start has a branch of its own
}

TEST(Together, sizes_are_bounded) {
  const std::string million = "\"linspace(1, 2, 1000000)\"\n";
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\n[sweep]\nnu = " + million + "f = " + million, "5:5",
       "a sweep of 1e+12 points; expected at most 1e+09"},
      {"[scene]\nxs = 1\n[observe]\nharmonics = 2048\n", "4:13", "less than half of harmonics_samples"},
      {"[scene]\nxs = 1\n[observe]\ntrajectory = 1\n", "4:14", "expected a whole number, 0 or 2 ... 1e7"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

}  // namespace
}  // namespace clatter::config::wrong_combination_test
