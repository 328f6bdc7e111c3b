#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "config/config_text.hpp"
#include "config/written_config.hpp"
#include "storage/error.hpp"

namespace clatter::config::config_reader_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const std::string fig22 = R"toml(title = "Minimum and maximum displacement, xs = -4"
source = "doi:10.5755/j02.mech.32277, Fig. 22"
[scene]
f = -1
h = 0.1
R = 0.7
xs = -4.0
[sweep]
nu = "linspace(0.5, 1.5, 501)"
[observe]
extrema = true
harmonics = 3
)toml";

const std::string fig22_ini =
    "; the twin of the TOML file\r\n"
    "title = \"Minimum and maximum displacement, xs = -4\"\r\n"
    "source = doi:10.5755/j02.mech.32277, Fig. 22   # where it comes from\r\n"
    "[scene]\r\n"
    "  f = -1.0\r\n"
    "xs = -4 ; the first surface\r\n"
    "h=0.1;no blank\r\n"
    "R = '0.7'\r\n"
    "[observe]\r\n"
    "harmonics = 3\r\n"
    "extrema = true\r\n"
    "[sweep]\r\n"
    "nu = linspace(0.5,1.5,501)\r\n";

TEST(Config, means_what_it_says) {
  const Config config = read_as("a.toml", fig22);
  EXPECT_EQ(config.title, "Minimum and maximum displacement, xs = -4");
  EXPECT_EQ(config.source, "doi:10.5755/j02.mech.32277, Fig. 22");
  EXPECT_EQ(config.compression, 0);
  EXPECT_EQ(size(config.sweep), 501u);
  const point::Problem scene = problem_at(config.sweep, 250);
  EXPECT_EQ(scene.oscillator.frequency, 1.0);
  EXPECT_EQ(scene.oscillator.forcing, -1.0);
  EXPECT_EQ(scene.stops.lower, -4.0);
  EXPECT_EQ(scene.stops.restitution_upper, 0.7);
  EXPECT_TRUE(scene.observe.extrema);
  EXPECT_FALSE(scene.observe.period);
  EXPECT_EQ(scene.observe.harmonics, 3);
}

TEST(Config, has_the_documented_defaults) {
  const sweep::GivenProblem scene = read_as("a.toml", "[scene]\nxs = 1\n").sweep.problem;
  EXPECT_EQ(scene.oscillator.damping, 0.0);
  EXPECT_EQ(scene.oscillator.frequency, 1.0);
  EXPECT_EQ(scene.stops.restitution_lower, 1.0);
  EXPECT_EQ(scene.time.mode, steady::Mode::steady);
  EXPECT_EQ(scene.time.max_periods, 5000);
  EXPECT_EQ(scene.time.window, 64);
  EXPECT_EQ(scene.time.tolerance, 1e-12);
  EXPECT_EQ(scene.time.max_impacts, 1e8);
  EXPECT_EQ(scene.observe.harmonics_samples, 4096);
  EXPECT_EQ(scene.observe.trajectory, 0);
}

TEST(Config, is_the_same_from_ini) {
  EXPECT_EQ(read_as("a.ini", fig22_ini).text, read_as("a.toml", fig22).text);
  EXPECT_EQ(read_as("a.ini", "\xEF\xBB\xBF" + fig22_ini).text, read_as("a.toml", "\xEF\xBB\xBF" + fig22).text);
}

TEST(Config, text_reads_back_to_itself) {
  const std::vector<std::string> texts{
      fig22,
      "title = \"Größe \\\"a\\\" \\\\ \\u0007 'b'\"\n[scene]\nstop_lower = -inf\nstop_upper = 0.1\nR_lower = 0.5\nload "
      "= 1e22\nf = 1e-320\n",
      "[scene]\nxs = -0.75\nstart_period = 3\n[output]\ncompression = 4\n",
      "[scene]\nxs = -0.75\n[sweep]\nstart_period = [1, 2, 3]\nnu = \"arange(1, 2, 0.25)\"\nfollow = \"nu\"\n",
      "[scene]\nxs = 2\nx0 = -0.0\n[sweep]\nv0 = \"logspace(1, 8, 4)\"\nf = [0.1, 0.2, 0.3, -0.0]\nlinked = \" f,v0 "
      "\"\n",
      "[scene]\nstop_upper = inf\n[sweep]\nstop_lower = [-inf, -1]\nR = \"linspace(0, 1, 3)\"\nphase = [\"pi\", "
      "\"-pi/2\"]\n",
      "[scene]\nxs = 1\n[time]\nmode = \"transient\"\nduration = \"20*pi\"\nmax_impacts = 1e6\n",
      "[scene]\nxs = 1\nR_upper = 0.5\n",
      "[scene]\nxs = 1\n[sweep]\nR_lower = [0.5, 0.6]\n",
      "[scene]\nxs = 1\nR_lower = 0.5\n[sweep]\nR_upper = [0.5, 0.6]\n",
  };
  for (const std::string& text : texts) {
    const std::string complete = read_as("a.toml", text).text;
    EXPECT_EQ(read_as("b.toml", complete).text, complete) << text;
  }
}

TEST(Config, text_has_both_restitutions_if_one_is_given) {
  const std::string fixed = read_as("a.toml", "[scene]\nxs = 1\nR_upper = 0.5\n").text;
  EXPECT_NE(fixed.find("\nR_lower = 1.0\nR_upper = 0.5\n"), std::string::npos) << fixed;
  const std::string swept = read_as("a.toml", "[scene]\nxs = 1\n[sweep]\nR_lower = [0.5]\n").text;
  EXPECT_NE(swept.find("\nxs = 1.0\nR_upper = 1.0\n"), std::string::npos) << swept;
  const std::string none = read_as("a.toml", "[scene]\nxs = 1\n").text;
  EXPECT_EQ(none.find("R_"), std::string::npos) << none;
  EXPECT_NE(none.find("\nR = 1.0\n"), std::string::npos) << none;
  for (const std::string& text : {fixed, swept}) {
    const point::Problem scene = problem_at(read_as("b.toml", text).sweep, 0);
    EXPECT_EQ(scene.stops.restitution_lower, text == fixed ? 1.0 : 0.5);
    EXPECT_EQ(scene.stops.restitution_upper, text == fixed ? 0.5 : 1.0);
  }
}

TEST(Config, too_long_to_run_again_is_refused_at_the_longest_value) {
  std::string escapes, numbers = "1";
  for (int i = 0; i < 300000; ++i) escapes += "\\n", numbers += ",1";
  EXPECT_EQ(
      mistake_in("a.toml", "title = \"" + escapes + "\"\n[scene]\nxs = 1\n"),
      "a.toml:1:1: the complete configuration is more than 1 MiB, of which 'title' takes 1800002 bytes; shorten it");
  EXPECT_EQ(mistake_in("a.toml", "[scene]\nxs = 1\n[sweep]\nf = [" + numbers + "]\n"),
            "a.toml:4:1: the complete configuration is more than 1 MiB, of which 'f' takes 1500005 bytes; write it as "
            "a function, e.g. linspace(a, b, n)");
}

TEST(Config, text_keeps_the_given_alternatives_only) {
  const std::string text = read_as("a.toml", "[scene]\nstop_lower=-1\nstop_upper=inf\nR_lower=0.5\n").text;
  EXPECT_EQ(text.find("xs ="), std::string::npos);
  EXPECT_EQ(text.find("\nR ="), std::string::npos);
  EXPECT_NE(text.find("stop_upper = inf\n"), std::string::npos);
  EXPECT_NE(text.find("x0 = 0.0\n"), std::string::npos);
  EXPECT_EQ(text.find("start_period"), std::string::npos);
  EXPECT_NE(text.find("stability = false\n"), std::string::npos);
  EXPECT_NE(text.find("effects = \"required\"\n"), std::string::npos);
}

TEST(Config, the_default_configuration_reads_the_same_from_toml_and_ini) {
  const std::string toml = read_as("d.toml", default_config(Format::toml)).text;
  EXPECT_EQ(read_as("d.ini", default_config(Format::ini)).text, toml);
  EXPECT_EQ(read_as("e.toml", "[scene]\nxs = -1").text, toml);
}

TEST(Config, one_stop_alone_has_its_restitution_and_the_other_is_none) {
  const Config lower = read_as("a.toml", "[scene]\nstop_lower=0\nR_lower=0.5\n");
  EXPECT_EQ(lower.sweep.problem.stops.lower, 0.0);
  EXPECT_EQ(lower.sweep.problem.stops.restitution_lower, 0.5);
  EXPECT_EQ(lower.sweep.problem.stops.restitution_upper, 1.0);
  EXPECT_EQ(lower.sweep.problem.stops.upper, infinity);
  EXPECT_EQ(lower.text, read_as("b.toml", "[scene]\nstop_lower=0\nstop_upper=inf\nR_lower=0.5\n").text);
  const Config upper = read_as("a.ini", "[sweep]\nstop_upper = 1, 2\n");
  EXPECT_EQ(problem_at(upper.sweep, 1).stops.lower, -infinity);
  EXPECT_EQ(problem_at(upper.sweep, 1).stops.upper, 2.0);
  EXPECT_EQ(upper.text, read_as("b.toml", "[scene]\nstop_lower = -inf\n[sweep]\nstop_upper = [1, 2]\n").text);
}

TEST(Axes, are_in_the_order_of_the_text_not_of_the_alphabet) {
  const Config config = read_as("a.toml", "[scene]\nxs = 1\n[sweep]\nnu = [1, 2]\nh = [0.1]\nf = [1, 2, 3]\n");
  ASSERT_EQ(config.sweep.dimensions.size(), 3u);
  EXPECT_EQ(config.sweep.dimensions[0][0].parameter, Parameter("nu"));
  EXPECT_EQ(config.sweep.dimensions[1][0].parameter, Parameter("h"));
  EXPECT_EQ(config.sweep.dimensions[2][0].parameter, Parameter("f"));
}

TEST(Axes, linked_ones_are_one_dimension_named_by_the_first) {
  const Config config =
      read_as("a.ini", "[scene]\nxs=1\n[sweep]\nnu = 1, 2\nh = 0.1, 0.2, 0.3\nf = 5, 6\nlinked = f, nu\nfollow = nu\n");
  ASSERT_EQ(config.sweep.dimensions.size(), 2u);
  EXPECT_EQ(config.sweep.dimensions[0][0].parameter, Parameter("h"));
  EXPECT_EQ(config.sweep.dimensions[1][0].parameter, Parameter("f"));  // stands where f stands
  EXPECT_EQ(config.sweep.dimensions[1][1].parameter, Parameter("nu"));
  EXPECT_EQ(config.sweep.follow, 1u);  // following one follows them all
  EXPECT_EQ(size(config.sweep), 6u);
}

TEST(Axes, stops_that_vary_together_are_compared_value_by_value) {
  const std::string text = "[scene]\nx0 = 1.5\n[sweep]\nstop_lower = [0, 1]\nstop_upper = [2, 3]\n";
  EXPECT_EQ(mistake_in("a.toml", text + "linked = \"stop_lower, stop_upper\"\n"), "");
  EXPECT_EQ(mistake_in("a.toml", "[sweep]\nxs = [1, 2]\nx0 = [-1, 2]\nlinked = \"xs, x0\"\n"), "");
  EXPECT_NE(mistake_in("a.toml", "[sweep]\nxs = [1, 2]\nx0 = [-1, 2]\n"), "");
}

TEST(Axes, along_follow_only_the_first_point_has_to_start_between_the_stops) {
  const std::string text = "[scene]\nx0 = 2\n[sweep]\nxs = [3, 1]\n";
  EXPECT_NE(mistake_in("a.toml", text), "");
  EXPECT_EQ(mistake_in("a.toml", text + "follow = \"xs\"\n"), "");
  EXPECT_NE(mistake_in("a.toml", "[scene]\nx0 = 2\n[sweep]\nxs = [1, 3]\nfollow = \"xs\"\n"), "");
}

TEST(Set, the_last_of_equal_ones_wins_over_the_file) {
  const Config config = read_as("a.toml", fig22, {{"scene.R", "0.2"}, {"scene.R", "0.3"}, {"title", "'new'"}});
  EXPECT_EQ(config.sweep.problem.stops.restitution_lower, 0.3);
  EXPECT_EQ(config.title, "new");
}

TEST(Set, replaces_an_axis_in_its_place_and_adds_one_at_the_end) {
  const std::string text = "[scene]\nxs = 1\n[sweep]\nnu = [1, 2]\nh = [0.1, 0.2]\n";
  const Config config = read_as("a.toml", text, {{"sweep.f", "[1, 2, 3]"}, {"sweep.nu", "5"}});
  ASSERT_EQ(config.sweep.dimensions.size(), 3u);
  EXPECT_EQ(config.sweep.dimensions[0][0].values, std::vector{5.0});
  EXPECT_EQ(config.sweep.dimensions[2][0].parameter, Parameter("f"));
}

TEST(Set, gives_the_text_of_the_file_that_says_the_same) {
  const std::string with_set = read_as("a.toml", fig22, {{"time.mode", "transient"}, {"time.duration", "2*pi"}}).text;
  EXPECT_EQ(with_set, read_as("b.toml", fig22 + "[time]\nmode = \"transient\"\nduration = \"2*pi\"\n").text);
}

TEST(Set, drops_blanks_around_key_and_value) {
  EXPECT_EQ(read_as("a.toml", fig22, {{"scene.R ", " 0.25"}}).sweep.problem.stops.restitution_lower, 0.25);
  EXPECT_EQ(read_as("a.toml", fig22, {{" time.mode", " 'steady' "}, {"title", " 'b ' "}}).title, "b ");
}

TEST(Set, not_in_utf8_is_an_error_of_the_words_not_of_a_file) {
  EXPECT_EQ(
      mistake_in("a.toml", fig22, {{"scene.R", "\xff"}}),
      "--set scene.R=\\xff: the byte \\xff is not UTF-8; use a terminal (or a script) in UTF-8, or put the text in "
      "a file");
}

TEST(Set, mistakes_name_the_words_of_the_command_line) {
  EXPECT_EQ(mistake_in("a.toml", fig22, {{"scene.R", "2"}}),
            "--set scene.R=2: R = 2 is out of range; expected 0 ... 1");
  EXPECT_EQ(mistake_in("a.toml", fig22, {{"scene.nuu", "2"}}),
            "--set scene.nuu=2: unknown key 'nuu' in [scene]; did you mean 'nu'?");
  EXPECT_EQ(mistake_in("a.toml", fig22, {{"scen.nu", "2"}}),
            "--set scen.nu=2: unknown section [scen]; did you mean [scene]?");
}

TEST(File, that_cannot_be_read_is_named_with_the_reason) {
  const support::TemporaryDirectory directory;
  EXPECT_THROW((void)read_config(directory.path("none.toml"), {}), storage::IoError);
  EXPECT_THROW((void)read_config(directory.path(""), {}), storage::IoError);
  EXPECT_THROW((void)read_config(directory.write("nul.toml", std::string("h = 1\0", 6)), {}), storage::IoError);
  try {
    (void)read_config("/none.toml", {});
  } catch (const storage::IoError& error) {
    EXPECT_EQ(std::string(error.what()), "/none.toml: cannot be read: No such file or directory");
  }
}

TEST(RunInChild, keeps_from_toml_the_texts_it_does_not_survive) {
  EXPECT_EQ(mistake_in("a.toml", std::string(2000000, '#')).substr(0, 10), "a.toml:1:1");
  std::string parts;
  for (int i = 0; i < 200000; ++i) parts += "a.";
  EXPECT_NE(mistake_in("a.toml", parts + "a = 1\n").find("more than 256 dots in a key"), std::string::npos);
  EXPECT_EQ(mistake_in("a.toml", "[*\n").substr(0, 9), "a.toml:1:");
  EXPECT_NE(mistake_in("a.toml", "[scene]\nh = ü\n").find("a.toml:2:5: a character outside ASCII"), std::string::npos);
  // quotes that toml++ takes for part of a number or word, or that end a text with quotes at its end
  for (const std::string line :
       {R"(h = 7"""é""")", "h = 7.'é'", R"(h = [1, 7["é"])", R"(h = 7="é")", R"(h = {f = 7"é"})", "h = [1,\n7\"é\"]",
        R"(title = """a"""" é)", "title = '''a''''' é", R"(title = """\é""")", "title = \"\"\"\\ \n  é\"\"\""})
    EXPECT_NE(mistake_in("a.toml", "[scene]\n" + line + "\n").find("a character outside ASCII"), std::string::npos)
        << line;
  for (const std::string text :
       {R"(title = "é")", "title = '''é''''", R"(title = """a "é""""")", R"(title = "\\é")", "source = 'é' # é",
        "\"title\" = \"é\"\n[scene]\nxs = 1\n[sweep]\nnu = [ 1,\n 2 ]\nlinked = \"é\""})
    EXPECT_EQ(mistake_in("a.toml", text + "\n").find("outside ASCII"), std::string::npos) << text;
  EXPECT_NE(mistake_in("a.toml", "[scene]\nh = \"\x80\"\n").find("a.toml:2:6: a byte that is not UTF-8"),
            std::string::npos);
  EXPECT_NE(mistake_in("a.toml", std::string(100000, '[')), "");
  std::string list = "0.5";
  for (int i = 0; i < 1000; ++i) list += ", 0.25";  // dots in a list of numbers are no danger
  EXPECT_EQ(mistake_in("a.toml", "[scene]\nxs = 1\n[sweep]\nnu = [" + list + "]\n"), "");
}

}  // namespace
}  // namespace clatter::config::config_reader_test
