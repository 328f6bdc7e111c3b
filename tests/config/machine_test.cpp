#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "config/settings.hpp"
#include "config/wrong_table.hpp"
#include "sweep/sweep.hpp"

namespace clatter::config::machine_test {
namespace {

const std::string machine = "[machine]\nmass = 0.5\nstiffness = 12.8e3\ngap = 4e-3\n";  // four lines

TEST(Machine, numbers_are_in_si_and_units_are_converted) {
  const std::string units =
      "[machine]\nmass = \"500 g\"\nstiffness = \"12.8 N/mm\"\ndamping = \"16 N s/m\"\nforce = \"-12.8 N\"\n"
      "frequency = \"2*pi*20 rad/s\"\nphase = \"pi/2 rad\"\nload = \"3 mN\"\nR = 0.7\nstop_lower = \"-3 mm\"\n"
      "stop_upper = \"4 mm\"\nbase_amplitude = \"50 um\"\nx0 = \"1 mm\"\nv0 = \"-20 mm/s\"\n"
      "[time]\nmode = \"transient\"\nduration = \"300 ms\"\n";
  const sweep::Sweep sweep = read_as("a.toml", units).sweep;
  ASSERT_TRUE(sweep.problem.is_si);
  EXPECT_EQ(sweep.problem.mass, 0.5);
  EXPECT_EQ(sweep.problem.oscillator.stiffness, 12800);
  EXPECT_EQ(sweep.problem.damper, 16);
  EXPECT_EQ(sweep.problem.oscillator.forcing, -12.8);
  EXPECT_DOUBLE_EQ(sweep.problem.oscillator.frequency, 20);  // 2 pi in and out
  EXPECT_EQ(sweep.problem.oscillator.load, 0.003);
  EXPECT_EQ(sweep.problem.stops.lower, -0.003);
  EXPECT_EQ(sweep.problem.stops.upper, 0.004);
  EXPECT_EQ(sweep.problem.stops.restitution_lower, 0.7);
  EXPECT_EQ(sweep.problem.shaking.base, 50e-6);
  EXPECT_EQ(sweep.problem.start.displacement, 0.001);
  EXPECT_EQ(sweep.problem.start.velocity, -0.02);
  EXPECT_EQ(sweep.problem.start.phase, std::numbers::pi / 2);
  EXPECT_EQ(sweep.problem.time.duration, 0.3);
}

TEST(Machine, damping_is_given_in_one_of_three_ways) {
  // c = 16 N s/m, c/(2 (K m)^(1/2)) = 0.1 and (K m)^(1/2)/c = 5 are the same
  for (const std::string given : {"damping = 16.0\n", "damping_ratio = 0.1\n", "quality = 5\n"})
    EXPECT_NEAR(problem_at(read_as("a.toml", machine + given).sweep, 0).oscillator.damping, 0.1, 1e-16) << given;
}

/// c = 2 zeta (kappa m)^(1/2), at every point of a sweep of all three, of each stop; the complete text says the same.
TEST(Machine, a_stop_damping_with_a_unit_is_the_damping_itself) {
  const std::string soft =
      "[machine]\nstiffness = 12.8e3\ngap = 4e-3\nstop_damping_lower = \"20 N s/m\"\n"
      "[sweep]\nmass = [0.5, 2]\nstop_stiffness = [1e4, 9e4, inf]\n"
      "stop_damping_upper = \"linspace(10 N s/m, 0.03 kN s/m, 3)\"\n";
  const Config config = read_as("a.toml", soft);
  EXPECT_NE(config.text.find("stop_damping_upper = \"linspace(10 N s/m, 30 N s/m, 3)\""), std::string::npos);
  EXPECT_NE(config.text.find("stop_damping_lower = \"20 N s/m\""), std::string::npos);
  const sweep::Sweep again = parse_config(config.text, "text").sweep;
  for (std::size_t i = 0; i < 18; ++i) {
    const Stops stops = problem_at(config.sweep, i).stops, others = problem_at(again, i).stops;
    const double mass = i < 9 ? 0.5 : 2, kappa = std::array{1e4, 9e4, HUGE_VAL}[i / 3 % 3],
                 root = std::sqrt(kappa * mass);
    EXPECT_NEAR(stops.damping_lower, 20 / (2 * root), 1e-15) << i;
    EXPECT_NEAR(stops.damping_upper, 10.0 * double(1 + i % 3) / (2 * root), 1e-15) << i;
    EXPECT_EQ(stops.damping_lower, others.damping_lower) << i;
    EXPECT_EQ(stops.damping_upper, others.damping_upper) << i;
  }
  const sweep::Sweep listed =
      read_as("a.toml", machine + "stop_stiffness = 1e4\n", {{"sweep.stop_damping", "1 N s/m, 2 mN s/mm"}}).sweep;
  EXPECT_EQ(listed.dimensions[0][0].values, (std::vector<double>{1, 2}));
  EXPECT_NEAR(problem_at(listed, 1).stops.damping_lower, 1 / std::sqrt(1e4 * 0.5), 1e-16);
  EXPECT_EQ(problem_at(listed, 1).stops.damping_lower, problem_at(listed, 1).stops.damping_upper);
}

TEST(Machine, every_number_is_an_axis) {
  for (const Key& key : keys()) {
    if (key.section != "machine" || key.kind != Kind::number) continue;  // a text is none
    const double value = std::get<double>(example_setting(key).value);
    const std::string name(key.name), example(key.example);
    const Config config = read_as("a.toml", "[machine]\n" + std::string(key.beside), {{"sweep." + name, example}});
    ASSERT_EQ(config.sweep.dimensions.size(), 1u) << name;
    EXPECT_EQ(config.sweep.dimensions[0][0].parameter.key(), name);
    EXPECT_EQ(config.sweep.dimensions[0][0].values, std::vector{value}) << name;
  }
}

TEST(Machine, axes_have_units_in_lists_and_functions) {
  const std::vector<double> expected{0.001, 0.002, 0.003};
  for (const char* const gap : {"gap = \"linspace(1 mm, 3 mm, 3)\"", "gap = [\"1 mm\", \"2 mm\", \"3 mm\"]",
                                "gap = \"1 mm, 2 mm, 3 mm\"", "gap = \"arange(1 mm, 4 mm, 1 mm)\""}) {
    const Config config = read_as("a.toml", "[machine]\nmass = 1\nstiffness = 1\n[sweep]\n" + std::string(gap) + "\n");
    const std::vector<double>& values = config.sweep.dimensions[0][0].values;
    ASSERT_EQ(values.size(), 3u) << gap;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(values[i], expected[i]) << gap;  // linspace rounds its steps
  }
}

/// As they stand on drawings, with characters outside ASCII, wherever a value may be written.
TEST(Machine, takes_the_units_of_drawings_in_toml_in_ini_and_on_the_command_line) {
  const std::string lists =
                        "gap = [\"50 \u00B5m\", \"60 \u03BCm\"]\nphase = \"linspace(0 \u00B0, 90 \u00B0, 2)\"\n"
                        "frequency = \"1500 rpm, 3000 1/min\"\nR = [\"60 %\", \"70%\"]\n",
                    plain =
                        "gap = 50 \u00B5m, 60 \u03BCm ; \u00B5\nphase = linspace(0\u00B0, 90\u00B0, 2)\n"
                        "frequency = 1500/min, 3000 min-1\nR = 60 %, 70%\n";
  const std::string head = "[machine]\nmass = 1\nstiffness = 1\nforce = 1\n";
  const std::vector<Override> changes{{"sweep.gap", "50 \u00B5m, 60 \u03BCm"},
                                      {"sweep.phase", "0 deg, 90\u00B0"},
                                      {"sweep.frequency", "1500 rpm, 3000 rpm"},
                                      {"sweep.R", "60 %, 70 %"}};
  for (const Config& config : {read_as("a.toml", head + "[sweep]\n" + lists),
                               read_as("a.ini", head + "[sweep]\n" + plain), read_as("b.toml", head, changes)}) {
    const auto& axes = config.sweep.dimensions;
    ASSERT_EQ(axes.size(), 4u);
    EXPECT_EQ(axes[0][0].values, (std::vector{50e-6, 60e-6}));
    EXPECT_EQ(axes[1][0].values, (std::vector{0.0, std::numbers::pi / 2}));
    EXPECT_EQ(axes[2][0].values, (std::vector{25.0, 50.0}));
    EXPECT_EQ(axes[3][0].values, (std::vector{0.6, 0.7}));
  }
}

TEST(Machine, a_scene_without_dimensions_takes_degrees_and_percent) {
  const sweep::Sweep sweep =
      read_as("a.toml",
              "[scene]\nxs = 1\nf = 1\nh = \"3 %\"\nR = \"60 %\"\nphase = \"90 \u00B0\"\n[branch]\nalong = \"R\"\n"
              "range = [\"50 %\", \"90 %\"]\n")
          .sweep;
  EXPECT_EQ(sweep.problem.oscillator.damping, 0.03);
  EXPECT_EQ(sweep.problem.stops.restitution_upper, 0.6);
  EXPECT_EQ(sweep.problem.start.phase, std::numbers::pi / 2);
}

TEST(Machine, percent_of_a_stop_damping_is_its_ratio) {
  const sweep::Sweep sweep = read_as("a.toml", machine + "stop_stiffness = 1e5\nstop_damping = \"10 %\"\n").sweep;
  EXPECT_EQ(sweep.problem.stops.damping_upper, 0.1);
  EXPECT_EQ(sweep.problem.stop_damper_upper, 0);
}

TEST(Machine, a_wrong_unit_is_told_with_the_one_that_was_meant) {
  const std::vector<Wrong> table{
      {machine + "damping = \"3 Ns/m\"\n", "5:14", "unknown unit 'Ns/m'; did you mean 'N s/m'?"},
      {machine + "damping = \"3 N/(m/s)\"\n", "5:14", "unknown unit 'N/(m/s)'; did you mean 'N s/m'?"},
      {machine + "frequency = \"25 hz\"\n", "5:17", "unknown unit 'hz'; did you mean 'Hz'?"},
      {machine + "frequency = \"1500 U/min\"\n", "5:19", "unknown unit 'U/min'; did you mean 'rpm'?"},
      {machine + "frequency = \"25 1/s\"\n", "5:17",
       "the unit '1/s' doesn't fit; expected a frequency in Hz, rad/s, rpm"},
      {machine + "load = \"3 lbf\"\n", "5:11", "1 lbf is 4.4482216152605 N"},
      {machine + "R = \"60 percent\"\n", "5:9", "unknown unit 'percent'; did you mean '%'?"},
      {machine + "x0 = \"3 %\"\n", "5:9", "the unit '%' doesn't fit; expected a length in m"},
      {machine + "[sweep]\nx0 = \"linspace(0, 2 microns, 3)\"\n", "6:21", "unknown unit 'microns'; did you mean 'um'?"},
      {"[scene]\nxs = 1\nphase = \"3 degrees\"\n", "3:12", "unknown unit 'degrees'; did you mean 'deg'?"},
      {"[scene]\nxs = 1\nphase = 3\u00B0\n", "3:10",
       "a character outside ASCII, '\u00B0' (U+00B0); put the text in quotes"},
      {"[scene]\nxs = 1\n[time]\nwindow = \"300 %\"\n", "4:10", "window = the text '300 %'; expected a whole number"},
  };
  expect_all("a.toml", table);
}

TEST(Machine, follows_and_links_its_axes_and_yields_to_the_command_line) {
  const Config config = read_as("a.ini",
                                "[machine]\nmass = 250 g\nstiffness = 1 kN/m ; of steel\ngap = 2 mm\n[sweep]\n"
                                "frequency = 10 Hz, 2*pi*20 rad/s\nforce = 1 N, 2 kN\nlinked = frequency, force\n"
                                "follow = force\n",
                                {{"machine.mass", "300 g"}, {"machine.stop_upper", "5 mm"}, {"machine.quality", "20"}});
  EXPECT_EQ(config.sweep.problem.mass, 0.3);
  EXPECT_EQ(config.sweep.problem.stops.lower, -0.002);
  EXPECT_EQ(config.sweep.problem.stops.upper, 0.005);
  EXPECT_EQ(config.sweep.follow, 0u);
  EXPECT_EQ(config.sweep.dimensions[0][1].values, (std::vector{1.0, 2000.0}));
  EXPECT_EQ(config.sweep.problem.quality, 20);
}

TEST(Machine, the_complete_text_is_the_same_machine) {
  const std::string axes =
      "damping = 3\n[sweep]\nfrequency = \"linspace(10 Hz, 2*pi*20 rad/s, 7)\"\nforce = [\"1 kN\"]\n";
  const Config config = read_as("a.toml", machine + axes), again = parse_config(config.text, "again");
  EXPECT_EQ(again.text, config.text);
  EXPECT_EQ(again.sweep.dimensions[0][0].values, config.sweep.dimensions[0][0].values);
  EXPECT_EQ(config.text.find("[scene]"), std::string::npos);
  EXPECT_EQ(config.text.find("damping_ratio"), std::string::npos);
}

TEST(Machine, wrong_machines) {
  const std::vector<Wrong> table{
      {"[machine]\ngap = 1\n", "1:2", "'mass' is missing in [machine]; give it in kg"},
      {"[machine]\nmass = 0\ngap = 1\n", "2:8", "mass = 0 is out of range; expected > 0, in kg"},
      {"[machine]\nmass = -1\ngap = 1\n", "2:8", "mass = -1 is out of range; expected > 0, in kg"},
      {"[machine]\nmass = 1\n", "1:2", "'gap' is missing in [machine]; give gap, or stop_lower, stop_upper or both"},
      {"[machine]\nmass = 1\nstop_upper = inf\n", "1:2", "no stiffness without stops, so nothing bounds the motion"},
      {machine + "damping = 1\nquality = 2\n", "6:1", "'quality' conflicts with 'damping'; remove one of them"},
      {machine + "damping_ratio = 1\ndamping = 2\n", "6:1", "'damping' conflicts with 'damping_ratio'"},
      {machine + "quality = 1\n[sweep]\ndamping_ratio = [1]\n", "7:1", "conflicts with 'quality'"},
      {"[machine]\nmass = 1\ngap = 1\nquality = 2\n", "4:1", "'quality' where the stiffness is 0"},
      {"[machine]\nmass = 1\ngap = 1\nquality = 2\n[sweep]\nstiffness = [1, 0]\n", "4:1", "give 'damping' in N s/m"},
      {machine + "force = 1\n", "5:1", "'force' without 'frequency'; add it to [machine] in Hz"},
      {machine + "base_amplitude = 1e-3\n", "5:1", "'base_amplitude' without 'frequency'"},
      {machine + "[sweep]\nforce = [0, 1]\n", "6:1", "'force' without 'frequency'"},
      {machine + "stop_lower = -1\n", "5:1", "'stop_lower' conflicts with 'gap'"},
      {machine + "x0 = 5e-3\n", "5:6", "x0 = 0.005 and gap = 0.004; expected a start between the stops"},
      {machine + "nu = 1\n", "5:1", "unknown key 'nu' in [machine]; there it is 'frequency'"},
      {"[scene]\nxs = 1\nforce = 1\n", "3:1", "unknown key 'force' in [scene]; there it is 'f'"},
      {"[scene]\nxs = 1\nmass = 1\n", "3:1", "unknown key 'mass' in [scene]; it belongs in [machine]"},
      {machine + "[sweep]\nnu = [1]\n", "6:1", "'nu' is a key of [scene], and [machine] describes this scene; vary "},
      {"[scene]\nxs = 1\n[sweep]\nmass = [1]\n", "4:1", "'mass' is a key of [machine], and [scene] describes this"},
      {"[scene]\nxs = 1\n[machine]\nmass = 1\n", "4:1", "machine.mass beside scene.xs, "},
      {"[machine]\nmass = 1\n[scene]\nxs = 1\n", "4:1", "describe the scene either in [scene], without units, or in"},
      {machine + "[branch]\nrange = [0.1, 0.2]\n", "5:2",
       "without 'along'; add a key of [machine], e.g. along = \"fre"},
      {machine + "[branch]\nalong = \"frequency\"\n", "5:2", "without 'range'; add the values to stop at, e.g. range"},
      {machine + "[branch]\nalong = \"nu\"\nrange = [0.1, 0.2]\n", "6:9",
       "'nu' is no key of [machine], which describes this scene; take 'frequency'"},
      {"[scene]\nxs = 1\n[branch]\nrange = [\"1 Hz\", \"2 Hz\"]\nalong = \"frequency\"\n", "5:9",
       "'frequency' is no key of [scene], which describes this scene; take 'nu'"},
      {machine + "[branch]\nalong = \"quality\"\nrange = [1, 2]\nacross = \"damping\"\ncurve = \"fold\"", "8:10",
       "'damping' and 'quality' change the same quantity; expected another key of [machine]"},
      {machine + "[branch]\nalong = \"mass\"\nrange = [0, 2]\n", "7:9", "range has mass = 0; expected > 0, in kg"},
  };
  expect_all("a.toml", table);
  const std::string named = mistake_in("a.toml", "[scene]\nxs = 1\n", {{"machine.mass", "1"}});
  EXPECT_NE(named.find("--set machine.mass=1: machine.mass beside scene.xs, "), std::string::npos) << named;
}

TEST(Machine, wrong_units) {
  const std::vector<Wrong> table{
      {machine + "damping = \"3 mm\"\n", "5:14", "the unit 'mm' doesn't fit; expected a damping in N s/m"},
      {machine + "force = \"3 kg\"\n", "5:12", "the unit 'kg' doesn't fit; expected a force in N"},
      {machine + "frequency = \"3 rad\"\n", "5:16",
       "the unit 'rad' doesn't fit; expected a frequency in Hz, rad/s, rpm"},
      {machine + "x0 = \"1 inch\"\n", "5:9", "unknown unit 'inch'; expected a length in m, by products and quotients"},
      {machine + "x0 = \"0.001\"\n", "5:6", "without quotes unless it holds pi or a unit"},
      {machine + "damping_ratio = \"3 N s/m\"\n", "5:20", "expected a number without unit, or 'damping' in N s/m"},
      {machine + "stop_stiffness = 1e5\nstop_damping = \"3 kg\"\n", "6:19",
       "expected a damping in N s/m, or a damping ratio without unit"},
      {machine + "stop_stiffness = 1e5\n[sweep]\nstop_damping = [\"3 N s/m\", 0.1]\n", "7:28",
       "0.1 without a unit beside a number with one; give each"},
      {machine + "stop_stiffness = 1e5\nstop_damping = 0.1\n[branch]\nalong = \"stop_damping\"\nrange = [\"0 N s/m\", "
                 "\"3 N s/m\"]\n",
       "9:9",
       "range of stop_damping is a damping in N s/m, and [machine] gives it as a number without unit; give both"},
      {"[scene]\nxs = 1\nstop_stiffness = 9\nstop_damping = \"3 N s/m\"\n", "4:19",
       "expected a number without unit, or the scene in [machine]"},
      {machine + "R = \"0.5 m\"\n", "5:10", "the unit 'm' doesn't fit; expected a number without unit"},
      {machine + "[sweep]\nx0 = [\"1 mm\", 2]\n", "6:15", "2 without a unit beside a number with one; give each"},
      {machine + "[sweep]\nx0 = \"linspace(1 mm, 2, 3)\"\n", "6:22", "2 without a unit beside a number with one"},
      {machine + "[sweep]\nx0 = \"linspace(0, 2 N, 3)\"\n", "6:21", "the unit 'N' doesn't fit; expected a length"},
      {machine + "[time]\nmode = \"transient\"\nduration = \"3 m\"\n", "7:15", "expected a time in s"},
      {"[scene]\nxs = \"3 mm\"\n", "2:9", "a number without unit, or the scene in [machine], which has units"},
      {"[scene]\nxs = 1\n[time]\nmode = \"transient\"\nduration = \"3 s\"\n", "5:15",
       "the unit 's' doesn't fit; expected a number without unit, or the scene in [machine]"},
      {machine + "[branch]\nalong = \"gap\"\nrange = [\"1 mm\", \"2 Hz\"]\n", "7:21",
       "doesn't fit; expected a length in m"},
      {machine + "[branch]\nalong = \"R\"\nrange = [\"1 mm\", 2]\n", "7:13",
       "the unit 'mm' doesn't fit; expected a number without"},
      {"[scene]\nxs = 1\n[branch]\nalong = \"nu\"\nrange = [\"1 Hz\", \"2 Hz\"]\n", "5:13",
       "expected a number without unit"},
      {"[scene]\nxs = 1\n[sweep]\nnu = [\"1 Hz\"]\n", "4:10", "a number without unit, or the scene in [machine]"},
  };
  expect_all("a.toml", table);
}

/// Of soft stops that may be given in two ways the one of the scene, or else of the range.
TEST(Machine, a_branch_follows_a_key_as_it_is_given) {
  const std::string soft = machine + "frequency = 20\nforce = 1\nstop_stiffness = 1e5\n";
  const auto along = [&](const std::string& given, const std::string& range) {
    return read_as("a.toml", soft + given + "[branch]\nalong = \"stop_damping\"\nrange = " + range + "\n")
        .branch->along;
  };
  EXPECT_EQ(along("stop_damping = 0.1\n", "[0, 1]"), Parameter("stop_damping"));
  EXPECT_EQ(along("", "[0, 1]"), Parameter("stop_damping"));
  for (const std::string given : {"stop_damping = \"1 N s/m\"\n", "stop_damping_upper = \"1 N s/m\"\n", ""}) {
    const Parameter damper = along(given, "[\"0 N s/m\", \"3 N s/m\"]");
    EXPECT_EQ(damper.key(), "stop_damping");
    EXPECT_EQ(damper.row().quantity, Quantity::damping);
  }
}

TEST(Machine, a_frequency_of_nothing_is_warned_of) {
  const Config config = read_as("a.toml", machine + "frequency = 3\n[observe]\nextrema = true\n");
  ASSERT_EQ(config.warnings.size(), 1u);
  EXPECT_NE(config.warnings[0].text.find("'frequency' has no effect without a force; leave it out, or give a force"),
            std::string::npos)
      << config.warnings[0].text;
}

}  // namespace
}  // namespace clatter::config::machine_test
