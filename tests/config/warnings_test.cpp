#include <gtest/gtest.h>

#include <cmath>

#include "config/config_text.hpp"
#include "config/written_config.hpp"

namespace clatter::config::warnings_test {
namespace {

using Lines = std::vector<std::string>;

/// The warnings of a configuration as "3:1: words", or "--set …: words".
Lines warnings_of(const std::string& name, const std::string& text, const std::vector<Override>& changes = {}) {
  const support::TemporaryDirectory directory;
  Lines lines;
  for (const Warning& warning : read_config(directory.write(name, text), changes).warnings) {
    const std::string file = directory.path("") + name + ':';
    const bool in_file = warning.location.starts_with(file);
    lines.push_back((in_file ? warning.location.substr(file.size()) : warning.location) + ": " + warning.text);
  }
  return lines;
}

/// A configuration that observes something.
std::string observing(const std::string& text) { return text + "[output]\n[observe]\nextrema = true\n"; }

void expect_warning(const std::string& text, const std::string& location, const std::string& words) {
  for (const std::string name : {"a.toml", "a.ini"}) {
    const Lines lines = warnings_of(name, text);
    ASSERT_EQ(lines.size(), 1u) << text;
    EXPECT_TRUE(lines[0].starts_with(location + ": ")) << lines[0];
    EXPECT_NE(lines[0].find(words), std::string::npos) << lines[0];
  }
}

void expect_none(const std::string& text) {
  for (const std::string name : {"a.toml", "a.ini"})
    for (const std::string& line : warnings_of(name, text)) ADD_FAILURE() << text << "\ngave " << line;
}

const std::string scene = "[scene]\nxs = 1\nf = 1\n";                                  // lines 1 to 3
const std::string transient = scene + "[time]\nmode = \"transient\"\nduration = 9\n";  // lines 1 to 6

TEST(Warnings, a_value_beside_its_axis) {
  const std::string both = "[scene]\nxs = 1\nR = 0.7\n[sweep]\nR = [0.5, 0.6]\n";
  expect_warning(observing(both), "3:1", "'R' has no effect beside its axis in [sweep], ");
  expect_warning(observing("[sweep]\nR = [0.5, 0.6]\n[scene]\nxs = 1\nR = 0.7\n"), "5:1", "leave one of them out");
  EXPECT_EQ(warnings_of("a.toml", observing("[scene]\nxs = 1\n"), {{"scene.R", "1"}, {"sweep.R", "0.5, 0.6"}}).size(),
            1u);
}

TEST(Warnings, an_angle_beyond_a_turn_without_unit) {
  const std::string driven = "[scene]\nxs = 1\nf = 1\n";
  expect_warning(observing(driven + "phase = 90\n"), "4:9",
                 "phase = 90 is in rad, more than a turn; if degrees are meant, give the unit: \"90 deg\"");
  expect_warning(observing(driven + "base_amplitude = 0.1\nstop_phase = -45.5\n"), "5:14",
                 "give the unit: \"-45.5 deg\"");
  EXPECT_TRUE(warnings_of("a.toml", observing(driven + "[sweep]\nphase = [0, 90]\n")).at(0).starts_with("5:13: phase"));
  expect_warning(driven + "[observe]\nsection = 8\nsection_phase = 90\n", "6:17", "section_phase = 90 is in rad");
  for (const char* const meant :
       {"phase = 6.28\n", "phase = \"90 deg\"\n", "phase = \"90 rad\"\n", "phase = \"4*pi\"\n"})
    expect_none(observing(driven + meant));
}

TEST(WithoutEffect, keys_of_the_other_mode_are_warned_of) {
  expect_warning(observing(scene + "[time]\nduration = 9\n"), "5:1",
                 "'duration' has no effect without mode = \"transient\"; leave it out, or write that in [time]");
  expect_warning(observing(transient + "window = 16\n"), "7:1",
                 "'window' has no effect in a transient; leave it out, or write mode = \"steady\" in [time]");
  expect_warning(observing(transient + "max_periods = 100\n"), "7:1", "'max_periods' has no effect in a transient");
  expect_warning(observing(transient + "tolerance = 1e-9\n"), "7:1", "'tolerance' has no effect in a transient");
  expect_none(observing(transient + "max_impacts = 100\n"));
  expect_none(observing(scene + "[time]\nwindow = 16\nmax_periods = 100\ntolerance = 1e-9\n"));
}

TEST(WithoutEffect, keys_of_other_methods_are_warned_of) {
  const std::string integrator = scene + "[integrator]\n";
  expect_warning(observing(integrator + "theta = 1\n"), "5:1",
                 "'theta' has no effect without method = \"moreau\"; leave it out, or write that in [integrator]");
  expect_warning(observing(integrator + "step = 0.01\n"), "5:1", "'step' has no effect without method = \"moreau\"");
  expect_warning(observing(integrator + "tolerance = 1e-8\n"), "5:1", "that of repeats is tolerance in [time]");
  expect_warning(observing(integrator + "method = \"dopri5\"\nstep = 0.01\n"), "6:1", "'step' has no effect");
  expect_warning(observing(integrator + "method = \"moreau\"\ntolerance = 1e-8\n"), "6:1", "'tolerance' has no effect");
  expect_warning(observing(transient + "[integrator]\nmethod = \"dopri5\"\neffects = \"all\"\n"), "9:1",
                 "'effects' has no effect on a transient by a general method");
  expect_none(observing(integrator + "method = \"dopri5\"\ntolerance = 1e-8\neffects = \"all\"\n"));
  expect_none(observing(integrator + "method = \"moreau\"\nstep = 0.01\ntheta = 1\n"));
  expect_none(observing(transient + "[integrator]\neffects = \"all\"\n"));
}

TEST(WithoutEffect, settings_of_harmonics_that_are_not_observed_are_warned_of) {
  const std::string observe = scene + "[observe]\nextrema = true\n";
  expect_warning(observe + "harmonics_samples = 512\n", "6:1",
                 "'harmonics_samples' has no effect without harmonics; leave it out, or write e.g. harmonics = 3");
  expect_warning(observe + "harmonics_method = \"exact\"\n", "6:1", "'harmonics_method' has no effect without");
  expect_warning(observe + "harmonics = 3\nharmonics_method = \"exact\"\nharmonics_samples = 512\n", "8:1",
                 "'harmonics_samples' has no effect with harmonics_method = \"exact\"; leave it out, or write "
                 "harmonics_method = \"fft\"");
  expect_none(observe + "harmonics = 3\nharmonics_samples = 512\n");
  expect_none(observe + "harmonics = 3\nharmonics_method = \"exact\"\n");
}

TEST(WithoutEffect, frequency_and_phase_without_a_force_are_warned_of) {
  const std::string free = "[scene]\nxs = 1\n";
  expect_warning(observing(free + "nu = 2\n"), "3:1", "'nu' has no effect without a force; leave it out, or give");
  expect_warning(observing(free + "f = 0\nphase = 1\n"), "4:1", "'phase' has no effect without a force");
  expect_warning(observing(free + "[sweep]\nnu = [1, 2]\n"), "4:1", "'nu' has no effect without a force");
  expect_none(observing(free + "nu = 2\n[sweep]\nf = [0, 1]\n"));
}

TEST(WithoutEffect, restitution_without_its_stop_is_warned_of) {
  expect_warning(observing("[scene]\nstop_upper = 1\nR_lower = 0.5\n"), "3:1",
                 "'R_lower' has no effect without a lower stop; leave it out, or give stop_lower");
  expect_warning(observing("[scene]\nstop_upper = inf\nstop_lower = -1\nR_upper = 0.5\n"), "4:1",
                 "'R_upper' has no effect without an upper stop");
  expect_warning(observing("[scene]\nstop_upper = inf\nR = 0.5\n"), "3:1", "'R' has no effect without stops");
  expect_warning(observing("[scene]\nstop_upper = inf\n[time]\nmax_impacts = 9\n"), "4:1", "'max_impacts' has no");
  expect_none(observing("[scene]\nstop_upper = 1\nR = 0.5\n"));
  expect_none(observing("[scene]\nR_lower = 0.5\n[sweep]\nstop_lower = [-inf, -1]\n"));
}

TEST(WithoutEffect, the_period_of_a_transient_is_warned_of) {
  const std::string time = "[time]\nmode = \"transient\"\nduration = 9\n[observe]\nperiod = true\n";
  expect_warning("[scene]\nstop_upper = 1\n" + time, "7:1", "'period' has no effect in a transient, which has none");
  expect_warning("[scene]\nstop_lower = -2\nstop_upper = 1\n" + time, "8:1", "'period' has no effect");
  expect_none("[scene]\nxs = 1\n" + time);  // the ratio of velocities
  expect_none("[scene]\nstop_lower = -1\nstop_upper = 1\n" + time);
}

TEST(WithoutEffect, section_and_period_of_motion_that_damping_stops_are_warned_of) {
  const std::string free = "[scene]\nxs = 1\nh = 0.1\n", observe = "[observe]\n";
  expect_warning(free + observe + "section = 3\n", "5:1",
                 "'section' has no effect without a force, since damping brings the mass to a standstill: its values "
                 "will be NaN; leave it out, or give a force, or mode = \"transient\" in [time]");
  expect_warning(free + observe + "period = true\n", "5:1", "'period' has no effect without a force, since damping");
  const std::string machine = "[machine]\nmass = 1\nstiffness = 1\ngap = 1\n";
  for (const char* const damping : {"damping = 0.1\n", "damping_ratio = 0.1\n", "quality = 9\n"})
    expect_warning(machine + damping + observe + "period = true\n", "7:1", "damping brings the mass to a standstill");
  expect_none(free + "[sweep]\nf = [0, 1]\n" + observe + "section = 3\nperiod = true\n");
  expect_none(free + "stop_amplitude = 1\n" + observe + "section = 3\nperiod = true\n");
  expect_none("[scene]\nxs = 1\n[sweep]\nh = [0, 0.1]\n" + observe + "section = 3\nperiod = true\n");
  expect_none(free + "[time]\nmode = \"transient\"\nduration = 9\n" + observe + "section = 3\n");
}

TEST(WithoutEffect, section_and_period_of_motion_that_friction_stops_are_warned_of) {
  const std::string free = "[scene]\nxs = 1\n", observe = "[observe]\n";
  const std::string warning = " has no effect without a force, since friction brings the mass to a standstill";
  expect_warning(free + "friction = 0.1\n" + observe + "section = 3\n", "5:1", "'section'" + warning);
  expect_warning("[machine]\nmass = 1\ngap = 1\n[sweep]\nfriction = [1, 2]\n" + observe + "period = true\n", "7:1",
                 "'period'" + warning);
  expect_none(free + "friction = 0.1\nf = 1\n" + observe + "section = 3\nperiod = true\n");
  expect_none(free + "[sweep]\nfriction = [0, 0.1]\n" + observe + "section = 3\nperiod = true\n");
  expect_none(free + "friction_static = 0.1\n" + observe + "section = 3\nperiod = true\n");  // it takes nothing
}

TEST(WithoutEffect, sticks_in_words_without_friction_or_words_are_warned_of) {
  const std::string sticks = "[observe]\nextrema = true\nword_sticks = true\n";
  expect_warning("[scene]\nxs = 1\nf = 1\n" + sticks + "word = true\n", "6:1",
                 "'word_sticks' has no effect without friction; leave it out, or give friction");
  expect_warning("[scene]\nxs = 1\nf = 1\nfriction = 0.1\n" + sticks, "7:1",
                 "'word_sticks' has no effect without word; leave it out, or write word = true");
  expect_none("[scene]\nxs = 1\nf = 1\n[sweep]\nfriction_static = [0, 0.1]\n" + sticks + "word = true\n");
}

TEST(WithoutEffect, a_section_that_a_rigid_stop_keeps_the_mass_from_is_warned_of) {
  const std::string ball = "[scene]\nload = -1\nstop_lower = 0\nx0 = 1\n", observe = "[observe]\nsection = 3\n";
  expect_warning(ball + "stiffness = 0\n" + observe, "7:1",
                 "'section' has no effect without a force and a spring, since between these stops the mass never "
                 "passes x = 0 on its way up: its values will be NaN; leave it out, or give a force");
  expect_warning("[scene]\nload = 1\nstop_upper = -2\nx0 = -3\nstiffness = 0\n" + observe, "7:1", "passes x = 0");
  expect_none(ball + observe);  // a spring: it is taken at x = -1
  expect_none(ball + "stiffness = 0\nf = 1\n" + observe);
  expect_none(ball + "stiffness = 0\nstop_stiffness = 9\n" + observe);
  expect_none("[scene]\nload = -1\nstop_lower = -1\nstiffness = 0\n" + observe);
}

TEST(WithoutEffect, is_said_of_set_in_its_words) {
  EXPECT_EQ(
      warnings_of("a.toml", observing(scene), {{"time.duration", "9"}}),
      Lines{"--set time.duration=9: 'duration' has no effect without mode = \"transient\"; leave it out, or write "
            "that in [time]"});
}

TEST(Observing, nothing_is_warned_of_unless_every_observable_is_written_as_off) {
  expect_warning("[scene]\nxs = 1\n", "1:1", "nothing is observed");
  expect_warning("[scene]\nxs = 1\n[observe]\nextrema = false\n", "3:2", "write e.g. extrema = true in [observe]");
  const std::string off =
      "[scene]\nxs = 1\n[observe]\nextrema = false\nharmonics = 0\nimpacts = false\nimpact_log = false\n"
      "trajectory = 0\nsection = 0\nword = false\nperiod = false\nstability = false\n";
  expect_warning(off, "3:2", "nothing is observed");
  expect_none(off + "energy = false\nsettling = false\ntime_to_rest = false\nattractor = false\n");
  for (const std::string alone : {"settling = true", "attractor = true", "stability = true", "section = 3"})
    expect_none(scene + "[observe]\n" + alone + "\n");
}

TEST(WithoutEffect, a_frame_of_stops_at_rest_is_warned_of) {
  const std::string absolute = "frame = \"absolute\"\n", shaken = "[scene]\nxs = 1\nstop_amplitude = 0.1\n[observe]\n";
  expect_warning(observing(scene) + absolute, "7:1",
                 "'frame' has no effect without stop_amplitude or base_amplitude; leave it out, or give one of them");
  expect_warning(shaken + "impacts = true\n" + absolute, "6:1",
                 "'frame' has no effect without displacements or velocities of the mass; leave it out, or write e.g. "
                 "extrema = true");
  for (const std::string observed :
       {"extrema = true", "trajectory = 9", "section = 3", "harmonics = 1", "attractor = true"})
    expect_none(shaken + observed + "\n" + absolute);
  expect_none("[scene]\nxs = 1\n[sweep]\nbase_amplitude = [0, 0.1]\n[observe]\nextrema = true\n" + absolute);
  expect_none(observing(scene) + "frame = \"relative\"\n");
}

TEST(Following, a_direction_of_nothing_is_warned_of) {
  const std::string sweep = observing(scene + "[sweep]\nnu = [0.8, 0.9]\ndirection = \"down\"\n");
  expect_warning(sweep, "6:1", "'direction' has no effect without follow; leave it out, or name an axis in follow");
  expect_none(observing(scene + "[sweep]\nnu = [0.8, 0.9]\nfollow = \"nu\"\ndirection = \"down\"\n"));
}

TEST(Observing, a_phase_of_a_section_without_one_is_warned_of) {
  const auto with = [](const char* observed) { return scene + "[observe]\n" + observed + "\nsection_phase = 1\n"; };
  expect_warning(with("extrema = true"), "6:1", "'section_phase' has no effect without a section");
  expect_warning("[scene]\nxs = 1\n[observe]\nsection = 5\nsection_phase = 1\n", "5:1",
                 "'section_phase' has no effect without a force");
  expect_none(with("section = 5"));
}

TEST(Repeats, on_a_crossing_axis_are_warned_of) {
  expect_warning(observing(scene + "[sweep]\nnu = [0.8, 0.9, 0.8, 0.9]\n"), "5:17",
                 "nu = 0.8 again, which computes the same points twice; give each value once");
  expect_warning(observing(scene + "[sweep]\nnu = \"linspace(1, 1, 3)\"\n"), "5:6", "nu = 1 again");
  expect_warning(observing(scene + "[sweep]\nh = [0, 1]\nx0 = [-0.0, 0.0]\n"), "6:13", "x0 = 0 again");
  expect_none(observing(scene + "[sweep]\nnu = [0.8, 0.9]\nh = [0.8, 0.9]\n"));
}

TEST(Repeats, on_linked_and_followed_axes_are_right) {
  expect_none(observing(scene + "[sweep]\nnu = [0.8, 0.8]\nh = [0.1, 0.2]\nlinked = \"nu, h\"\n"));
  expect_none(observing(scene + "[sweep]\nnu = [0.8, 0.9, 0.8]\nfollow = \"nu\"\n"));
}

TEST(Ratios, of_stops_far_beyond_critical_damping_are_warned_of_in_a_machine) {
  const std::string machine = "[machine]\nmass = 1\nstiffness = 1e4\ngap = 1e-3\nstop_stiffness = 1e6\n";
  expect_warning(observing(machine + "stop_damping = 40\n"), "6:16",
                 "stop_damping = 40 is the damping ratio, 40 times critical; if the damping is meant, give its unit");
  expect_warning(observing(machine + "[sweep]\nstop_damping_upper = [0.1, 3]\n"), "7:28", "stop_damping_upper = 3 is");
  expect_none(observing(machine + "stop_damping = 2\n"));
  EXPECT_EQ(warnings_of("a.toml", observing(machine + "stop_damping = \"40 N s/m\"\n")), Lines{});
  expect_none(observing("[scene]\nxs = 1\nstop_stiffness = 9\nstop_damping = 40\n"));
}

TEST(Axes, that_one_value_replaces_are_told) {
  const std::string swept = observing("[scene]\nxs = 1\n[sweep]\nR = \"linspace(0, 1, 1401)\"\n");
  const Lines lines = warnings_of("a.toml", swept, {{"scene.R", "0.5"}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].starts_with("--set scene.R=0.5: one value in place of the 1401 of 'R' in [sweep]")) << lines[0];
  EXPECT_EQ(warnings_of("a.toml", swept, {{"sweep.R", "0.5"}}), Lines{});
  EXPECT_EQ(warnings_of("a.toml", observing("[scene]\nxs = 1\n[sweep]\nR = [0.5]\n"), {{"scene.R", "0.6"}}), Lines{});
}

TEST(Warnings, are_none_if_every_default_is_written) {
  expect_none(default_config(Format::toml));
  EXPECT_EQ(warnings_of("a.ini", default_config(Format::ini)), Lines{});
  for (const std::string& text : {observing(transient), observing("[scene]\nstop_upper = 1\nR = 0.5\n"),
                                  observing(scene + "[integrator]\nmethod = \"moreau\"\n")})
    EXPECT_EQ(warnings_of("a.toml", read_as("b.toml", text).text), Lines{}) << text;
}

}  // namespace
}  // namespace clatter::config::warnings_test
