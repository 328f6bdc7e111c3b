#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "config/written_config.hpp"

namespace clatter::config::precedence_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Overrides = std::vector<Override>;

/// The complete text of a configuration with changes is that of one that says so itself.
void expect_same(const std::string& text, const Overrides& changes, const std::string& meant) {
  EXPECT_EQ(read_as("a.toml", text, changes).text, read_as("b.toml", meant).text) << text;
  EXPECT_EQ(read_as("a.ini", text, changes).text, read_as("b.toml", meant).text) << text;
}

/// The notes of a configuration, without the name of its directory.
std::vector<std::string> notes_of(const std::string& text, const Overrides& changes) {
  const support::TemporaryDirectory directory;
  std::vector<std::string> notes = read_config(directory.write("a.toml", text), changes).notes;
  for (std::string& note : notes) {
    const std::size_t at = note.find(directory.path(""));
    if (at != std::string::npos) note.erase(at, directory.path("").size());
  }
  return notes;
}

const std::string fixed = "[scene]\nxs = -4\nR = 0.7\nnu = 1.5\n";
const std::string swept = "[scene]\nxs = -4\n[sweep]\nR = [0.5, 0.6]\nnu = [1, 2]\n";

TEST(Precedence, an_axis_of_the_command_line_comes_before_the_scene_of_the_file) {
  expect_same(fixed, {{"sweep.R", "0.5, 0.6"}}, "[scene]\nxs = -4\nnu = 1.5\n[sweep]\nR = [0.5, 0.6]\n");
  EXPECT_EQ(notes_of(fixed, {{"sweep.R", "0.5, 0.6"}}),
            std::vector<std::string>{"--set sweep.R=0.5, 0.6 in place of 'R', a.toml:3:1"});
}

TEST(Precedence, a_value_of_the_command_line_comes_before_the_axis_of_the_file) {
  expect_same(swept, {{"scene.R", "0.9"}}, "[scene]\nxs = -4\nR = 0.9\n[sweep]\nnu = [1, 2]\n");
  EXPECT_EQ(notes_of(swept, {{"scene.R", "0.9"}}),
            std::vector<std::string>{"--set scene.R=0.9 in place of 'R', a.toml:4:1"});
}

TEST(Precedence, one_stop_of_the_command_line_leaves_the_other_of_xs) {
  expect_same(fixed, {{"scene.stop_upper", "5"}}, "[scene]\nstop_lower = -4\nstop_upper = 5\nR = 0.7\nnu = 1.5\n");
  expect_same(fixed, {{"scene.stop_lower", "-inf"}}, "[scene]\nstop_lower = -inf\nstop_upper = 4\nR = 0.7\nnu = 1.5\n");
  expect_same(fixed, {{"sweep.stop_upper", "5, 6"}},
              "[scene]\nstop_lower = -4\nR = 0.7\nnu = 1.5\n[sweep]\nstop_upper = [5, 6]\n");
  EXPECT_EQ(notes_of(fixed, {{"scene.stop_upper", "5"}}),
            std::vector<std::string>{"--set scene.stop_upper=5 in place of 'xs', a.toml:2:1, which stays as "
                                     "'stop_lower'"});
}

TEST(Precedence, both_stops_of_the_command_line_leave_nothing_of_xs) {
  expect_same(fixed, {{"scene.stop_upper", "5"}, {"scene.stop_lower", "-6"}},
              "[scene]\nstop_lower = -6\nstop_upper = 5\nR = 0.7\nnu = 1.5\n");
}

TEST(Precedence, one_stop_of_the_command_line_leaves_the_other_of_an_axis) {
  const std::string axis = "[sweep]\nxs = \"linspace(-1, -2, 3)\"\nR = [0.5, 0.6, 0.7]\nlinked = \"R,xs\"\n";
  expect_same(axis, {{"scene.stop_upper", "5"}},
              "[scene]\nstop_upper = 5\n[sweep]\nstop_lower = \"linspace(-1, -2, 3)\"\nR = [0.5, 0.6, 0.7]\n"
              "linked = \"R, stop_lower\"\n");
  expect_same(axis, {{"scene.stop_lower", "-inf"}},
              "[scene]\nstop_lower = -inf\n[sweep]\nstop_upper = [1, 1.5, 2]\nR = [0.5, 0.6, 0.7]\n"
              "linked = \"R, stop_upper\"\n");
}

TEST(Precedence, xs_of_the_command_line_comes_before_both_stops) {
  const std::string unequal = "[scene]\nstop_lower = -1\n[sweep]\nstop_upper = [2, 3]\n";
  expect_same(unequal, {{"scene.xs", "4"}}, "[scene]\nxs = 4\n");
  expect_same(unequal, {{"sweep.xs", "4, 5"}}, "[sweep]\nxs = [4, 5]\n");
  EXPECT_EQ(notes_of(unequal, {{"scene.xs", "4"}}).size(), 2u);
}

TEST(Precedence, one_restitution_of_the_command_line_leaves_the_other_of_R) {
  expect_same(fixed, {{"scene.R_lower", "0.2"}}, "[scene]\nxs = -4\nR_lower = 0.2\nR_upper = 0.7\nnu = 1.5\n");
  expect_same(swept, {{"scene.R_upper", "0.2"}},
              "[scene]\nxs = -4\nR_upper = 0.2\n[sweep]\nR_lower = [0.5, 0.6]\nnu = [1, 2]\n");
  expect_same("[scene]\nxs = 1\nR_lower = 0.5\nR_upper = 0.6\n", {{"scene.R", "0.9"}}, "[scene]\nxs = 1\nR = 0.9\n");
}

TEST(Precedence, a_start_of_the_command_line_comes_before_the_other_of_the_file) {
  expect_same("[scene]\nxs = 1\nx0 = 0.5\nv0 = 2\n", {{"scene.start_period", "3"}},
              "[scene]\nxs = 1\nstart_period = 3\n");
  expect_same("[scene]\nxs = 1\n[sweep]\nstart_period = [2, 3]\n", {{"scene.v0", "2"}}, "[scene]\nxs = 1\nv0 = 2\n");
}

TEST(Precedence, two_values_in_one_file_or_command_line_stay_a_mistake) {
  const auto says = [](const std::string& text, const Overrides& changes, const std::string& words) {
    const std::string mistake = mistake_in("a.toml", text, changes);
    EXPECT_NE(mistake.find(words), std::string::npos) << mistake;
  };
  says(fixed, {{"scene.R", "1"}, {"scene.R_lower", "1"}}, "'R' conflicts with 'R_lower'; remove one of them");
  says(fixed, {{"scene.xs", "1"}, {"scene.stop_upper", "2"}}, "'xs' conflicts with 'stop_upper'; remove one of them");
  says(swept, {{"scene.R", "0.5"}, {"sweep.R_lower", "0.1, 0.2"}}, "'R' conflicts with 'R_lower'; remove one of them");
  says("[scene]\nxs = 1\n[sweep]\nR_lower = [0.1, 0.2]\n", {{"scene.R", "0.5"}, {"scene.R_lower", "1"}},
       "'R' conflicts with 'R_lower'; remove one of them");
  says(fixed + "stop_upper = 5\n", {{"scene.stop_lower", "-1"}}, "a.toml:5:1: 'stop_upper' conflicts with 'xs'");
}

/// As when a run is turned into a sweep.
TEST(Precedence, of_a_value_and_an_axis_in_one_place_the_axis_counts) {
  const std::string both = "[scene]\nxs = -4\nR = 0.7\n[sweep]\nR = [0.5, 0.6]\n";
  expect_same(both, {}, "[scene]\nxs = -4\n[sweep]\nR = [0.5, 0.6]\n");
  expect_same("[scene]\nxs = -4\n", {{"scene.f", "1"}, {"sweep.f", "1, 2"}}, "[scene]\nxs = -4\n[sweep]\nf = [1, 2]\n");
  expect_same(both, {{"scene.R", "0.9"}}, "[scene]\nxs = -4\nR = 0.9\n");  // the command line wins over both
}

TEST(Precedence, an_axis_that_is_gone_is_named_in_the_error_that_misses_it) {
  EXPECT_EQ(mistake_in("a.toml", swept + "follow = \"nu\"\n", {{"scene.nu", "1"}}),
            "a.toml:6:10: follow names 'nu', which is no axis of [sweep] with --set scene.nu=1; add --set "
            "sweep.follow=''");
  EXPECT_EQ(mistake_in("a.toml", swept + "follow = \"nu\"\n", {{"scene.nu", "1"}, {"sweep.follow", "''"}}), "");
}

/// A configuration and changes that give many keys in many ways, some of them wrong.
struct Mixture {
  std::string text;
  Overrides changes;
};

Mixture mixture(std::mt19937& random) {
  std::string in_scene, in_sweep;
  Overrides changes;
  for (const char* const key : {"xs", "stop_lower", "stop_upper", "R", "R_lower", "R_upper", "x0", "v0", "nu"}) {
    const std::string name = key, low = name == "stop_lower" ? "-2" : "0.5", high = name == "stop_lower" ? "-1" : "1";
    const std::string list = "[" + low + ", " + high + "]";
    const auto choice = random() % 25;
    if (choice < 6) in_scene += name + " = " + low + '\n';
    if (choice == 6 || choice == 7) in_sweep += name + " = " + list + '\n';
    if (choice > 21) changes.push_back({"scene." + name, high});
    if (choice > 4 && choice < 8)
      changes.push_back({(choice == 5 ? "sweep." : "scene.") + name, choice == 5 ? list : high});
  }
  if (in_sweep.starts_with("xs")) in_sweep += "follow = \"xs\"\n";
  return {"[scene]\n" + in_scene + "[sweep]\n" + in_sweep, changes};
}

TEST(Precedence, gives_a_complete_text_that_gives_itself_again) {
  std::mt19937 random(20);
  int taken = 0;
  for (int i = 0; i < 200; ++i) {
    const Mixture mixed = mixture(random);
    if (!mistake_in("a.toml", mixed.text, mixed.changes).empty()) continue;
    const std::string complete = read_as("a.toml", mixed.text, mixed.changes).text;
    EXPECT_EQ(mistake_in("b.toml", complete), "") << mixed.text;
    EXPECT_EQ(read_as("b.toml", complete).text, complete) << mixed.text;
    ++taken;
  }
  EXPECT_GT(taken, 40);
}

TEST(Precedence, a_way_to_damp_a_soft_stop_comes_before_that_of_the_file) {
  const std::string soft = "[scene]\nxs = 4\nstop_stiffness = 9\n";
  expect_same(soft + "stop_damping = 0.1\n", {{"scene.stop_R", "0.5"}}, soft + "stop_R = 0.5\n");
  expect_same(soft + "stop_R = 0.5\n", {{"sweep.stop_damping", "0.1, 0.2"}},
              soft + "[sweep]\nstop_damping = [0.1, 0.2]\n");
  expect_same(soft + "stop_R_lower = 0.5\nstop_damping_upper = 0.2\n", {{"scene.stop_R_upper", "0.4"}},
              soft + "stop_R_lower = 0.5\nstop_R_upper = 0.4\n");
  expect_same(soft + "stop_R = 0.5\n", {{"scene.stop_damping_lower", "0.1"}},
              soft + "stop_damping_lower = 0.1\nstop_R_upper = 0.5\n");
  expect_same(soft + "stop_R = 0.5\n", {{"scene.R", "0.6"}}, "[scene]\nxs = 4\nR = 0.6\n");
}

TEST(Precedence, nothing_is_noted_if_nothing_gives_way) {
  EXPECT_EQ(notes_of(fixed, {{"scene.R", "0.5"}, {"scene.f", "1"}}), std::vector<std::string>{});
  EXPECT_EQ(read_as("a.toml", fixed, {{"scene.stop_upper", "inf"}}).sweep.problem.stops.upper, infinity);
}

}  // namespace
}  // namespace clatter::config::precedence_test
