#include <gtest/gtest.h>

#include <cmath>

#include "io/keys.hpp"
#include "io/value_grammar.hpp"
#include "io/written_config.hpp"

namespace clatter {
namespace {

/// A configuration that is right but for its fourth line, which stands in the section.
std::string config_with(std::string_view section, const std::string& line) {
  const std::string stops = line.starts_with("xs") ? "h = 0.1\n" : "xs = 4.0\n";
  if (section.empty()) return "\n\n\n" + line + "\n[scene]\n" + stops;
  if (section == "scene") return "\n[scene]\n" + stops + line + '\n';
  return "[scene]\n" + stops + '[' + std::string(section) + "]\n" + line + '\n';
}

/// The mistake in line 4 must be found at a column, in TOML and in INI, with these words.
void expect_mistake(const Key& key, const std::string& section, const std::string& line, int column,
                    const std::string& words, std::string_view formats = "both") {
  for (const std::string name : {"a.toml", "a.ini"}) {
    if (formats != "both" && !name.ends_with(formats)) continue;
    const std::string mistake = mistake_in(name, config_with(section, line));
    const std::string place = name + ":4:" + std::to_string(column) + ": ";
    EXPECT_TRUE(mistake.starts_with(place)) << key.name << ": " << line << "\ngave " << mistake << "\nnot at " << place;
    EXPECT_NE(mistake.find(words), std::string::npos) << line << "\ngave " << mistake << "\nwithout " << words;
    EXPECT_EQ(mistake.find('\n'), std::string::npos) << mistake;
  }
}

/// The same for a value of a key: the column is that of the value.
void expect_wrong_value(const Key& key, const std::string& value, const std::string& words,
                        std::string_view formats = "both") {
  const std::string name(key.name);
  expect_mistake(key, std::string(key.section), name + " = " + value, static_cast<int>(name.size()) + 4, words,
                 formats);
}

bool is_numeric(const Key& key) { return key.kind == Kind::number || key.kind == Kind::integer; }

TEST(EveryKey, misspelt_is_unknown) {
  for (const Key& key : keys()) {
    const std::string misspelt = std::string(key.name) + "q";
    const std::string words = "unknown key '" + misspelt + (key.name.size() > 1 ? "'" : "");
    expect_mistake(key, std::string(key.section), misspelt + " = 1", 1, words);
    if (key.name.size() > 1) {
      expect_mistake(key, std::string(key.section), misspelt + " = 1", 1,
                     "did you mean '" + std::string(key.name) + "'?");
    }
  }
}

TEST(EveryKey, in_a_wrong_section_is_sent_to_the_right_one) {
  for (const Key& key : keys()) {
    const std::string section = key.section == "output" ? "time" : "output";
    expect_mistake(key, section, std::string(key.name) + " = 1", 1,
                   "unknown key '" + std::string(key.name) + "' in [" + section + "]");
  }
}

TEST(EveryKey, given_twice_is_refused_at_the_second) {
  for (const Key& key : keys()) {
    const std::string line = std::string(key.name) + " = 1";
    for (const std::string name : {"a.toml", "a.ini"}) {
      const std::string mistake = mistake_in(name, config_with(key.section, line + "\n  " + line));
      EXPECT_TRUE(mistake.starts_with(name + ":5:3: ")) << mistake;
    }
  }
}

TEST(EveryKey, of_the_wrong_kind_says_what_is_permitted) {
  for (const Key& key : keys()) {
    const std::string words = permitted(key);
    if (is_numeric(key)) {
      expect_wrong_value(key, "true", words, "toml");
      expect_wrong_value(key, "\"many\"", words, "toml");
      expect_wrong_value(key, "\"0.5\"", "without quotes", "toml");
      expect_wrong_value(key, "[1]", words, "toml");
      expect_wrong_value(key, "{}", words, "toml");
      expect_wrong_value(key, "1979-05-27", "a date", "toml");
      expect_wrong_value(key, "true", "expected a number", "ini");
      expect_wrong_value(key, "many", "expected a number", "ini");
      expect_wrong_value(key, "[1]", "expected a number", "ini");
    } else if (key.kind == Kind::flag) {
      for (const char* value : {"1", "yes", "True"}) expect_wrong_value(key, value, words, "ini");
      for (const char* value : {"1", "\"true\"", "0.0", "[true]"}) expect_wrong_value(key, value, words, "toml");
    } else {
      for (const char* value : {"1", "true", "[\"a\"]"}) expect_wrong_value(key, value, words, "toml");
    }
    if (key.kind == Kind::choice) expect_wrong_value(key, "\"?\"", words);
    if (key.kind == Kind::names) expect_wrong_value(key, "\"nu\"", "is no axis of [sweep]");
  }
}

TEST(EveryKey, without_a_value_is_refused) {
  for (const Key& key : keys()) {
    if (key.kind == Kind::text || key.kind == Kind::names) continue;  // an empty text is one
    const std::string name(key.name);
    expect_mistake(key, std::string(key.section), name + " =", static_cast<int>(name.size()) + 3, "", "ini");
    EXPECT_NE(mistake_in("a.toml", config_with(key.section, name + " =")), "");
  }
}

TEST(EveryNumber, that_is_nan_or_infinite_is_refused) {
  for (const Key& key : keys()) {
    if (!is_numeric(key)) continue;
    for (const char* value : {"nan", "inf", "-inf"}) {
      const bool is_stop = key.range.infinite && std::string_view(value) != "nan";
      if (!is_stop) expect_wrong_value(key, value, "permitted: " + permitted(key));
    }
    expect_wrong_value(key, "1e999", "", "ini");
  }
}

TEST(EveryNumber, out_of_its_range_is_refused_with_the_range) {
  int bounded = 0;
  for (const Key& key : keys()) {
    if (!is_numeric(key)) continue;
    const Range& range = key.range;
    const std::string words = "out of range; permitted: " + permitted(key);
    if (range.not_zero) expect_wrong_value(key, "0", words);
    if (std::isfinite(range.low)) expect_wrong_value(key, "-1", words);
    if (std::isfinite(range.low) && range.open) expect_wrong_value(key, number_text(range.low), words);
    if (std::isfinite(range.high)) expect_wrong_value(key, toml_number(range.high * 2 + 1), words);
    if (std::isfinite(range.high) && range.open) expect_wrong_value(key, toml_number(range.high), words);
    bounded += range.not_zero || std::isfinite(range.low) ? 1 : 0;
  }
  EXPECT_GE(bounded, 16);  // all but f, phase, load, x0, v0 and the stops
}

TEST(EveryCount, that_is_a_fraction_is_refused) {
  for (const Key& key : keys()) {
    if (key.kind == Kind::integer) expect_wrong_value(key, "2.5", "2.5 is a fraction; permitted: a whole number");
  }
}

TEST(EveryAxis, is_checked_like_the_scene) {
  for (const Key& key : keys()) {
    if (key.section != "scene") continue;
    const std::string name(key.name);
    const int column = static_cast<int>(name.size()) + 4;
    for (const std::string file : {"a.toml", "a.ini"}) {
      const auto mistake = [&](const std::string& value) {
        return mistake_in(file, "[sweep]\n" + name + " = " + value + "\n");
      };
      const std::string line = file + ":2:";
      EXPECT_TRUE(mistake("[0.5, nan]").starts_with(line + std::to_string(column + 6))) << mistake("[0.5, nan]");
      EXPECT_TRUE(mistake("[]").starts_with(line + std::to_string(column) + ": an empty axis")) << mistake("[]");
      EXPECT_TRUE(mistake("\"arange(1, 1, 1)\"").starts_with(line + std::to_string(column + 1) + ": an empty axis"));
      EXPECT_TRUE(mistake("\"linspace(1, 2)\"").starts_with(line + std::to_string(column + 14)))
          << mistake("\"linspace(1, 2)\"");
      if (key.range.low == 0 && std::isfinite(key.range.high)) {
        EXPECT_TRUE(mistake("\"linspace(-1, 0, 3)\"")
                        .starts_with(line + std::to_string(column) + ": " + name + " = -1 is out of range"));
      }
    }
  }
}

struct Wrong {
  std::string text;
  std::string place;  ///< "line:column"
  std::string words;
};

void expect_all(const std::string& name, const std::vector<Wrong>& table) {
  for (const Wrong& wrong : table) {
    const std::string mistake = mistake_in(name, wrong.text);
    EXPECT_TRUE(mistake.starts_with(name + ':' + wrong.place + ": ")) << wrong.text << "\ngave " << mistake;
    EXPECT_NE(mistake.find(wrong.words), std::string::npos) << wrong.text << "\ngave " << mistake;
    EXPECT_EQ(mistake.find('\n'), std::string::npos) << mistake;
  }
}

const std::string both = "[scene]\nxs = 1\n[sweep]\nnu = [1, 2]\n";

TEST(Together, alternatives_exclude_each_other) {
  const std::vector<Wrong> table{
      {both + "xs = [1]\n", "5:1", "'xs' in both [scene] and [sweep]; remove one of them"},
      {"[sweep]\nnu = [1]\n[scene]\nxs = 1\n nu = 1\n", "5:2", "'nu' in both [scene] and [sweep]"},
      {"[scene]\nxs = 1\nstop_lower = -1\n", "3:1", "'stop_lower' beside 'xs'"},
      {"[scene]\nstop_lower = -1\nstop_upper = 1\nxs = 1\n", "4:1", "'xs' beside 'stop_lower'"},
      {both + "stop_upper = [1]\n", "5:1", "'stop_upper' beside 'xs'"},
      {"[scene]\nxs = 1\nR = 1\nR_lower = 1\n", "4:1", "'R_lower' beside 'R'"},
      {"[scene]\nxs = 1\nR_upper = 1\n[sweep]\nR = [1]\n", "5:1", "'R' beside 'R_upper'"},
      {"[scene]\nxs = 1\nstart_period = 3\nx0 = 0\n", "4:1", "'x0' beside 'start_period'"},
      {"[scene]\nxs = 1\nv0 = 1\n[sweep]\nstart_period = [3]\n", "5:1", "'start_period' beside 'v0'"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, what_is_missing_is_missed_at_its_section) {
  const std::vector<Wrong> table{
      {"", "1:1", "'xs' is missing in [scene]"},
      {"[time]\nwindow = 1\n", "1:1", "'xs' is missing in [scene]; give xs, or stop_lower and stop_upper"},
      {"\n [scene]\nf = 1\n", "2:3", "'xs' is missing"},
      {"[scene]\nstop_lower = -inf\n", "1:2", "'stop_upper' is missing in [scene]; give inf"},
      {"[scene]\nstop_upper = 1\n", "1:2", "'stop_lower' is missing in [scene]; give -inf"},
      {"[scene]\nxs = 1\n[time]\nmode = \"transient\"\n", "3:2", "'duration' is missing in [time]"},
      {"[scene]\nxs = 1\n[time]\nmode = \"transient\"\nduration = 0\n", "5:12",
       "duration = 0 is out of range; permitted: > 0"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, the_start_is_between_stops_in_order) {
  const std::vector<Wrong> table{
      {"[scene]\nstop_lower = 2\nstop_upper = 1\n", "2:14",
       "stop_lower = 2 and stop_upper = 1; permitted: stop_lower < stop_upper"},
      {"[scene]\nstop_lower = 1\nstop_upper = 1\n", "2:14", "permitted: stop_lower < stop_upper"},
      {"[scene]\nstop_lower = inf\nstop_upper = -inf\n", "2:14", "permitted: stop_lower < stop_upper"},
      {"[scene]\nxs = -1\nx0 = 1.5\n", "3:6",
       "x0 = 1.5 and |xs| = 1; permitted: a start between the stops, -|xs| <= x0 <= |xs|"},
      {"[scene]\nxs = -1\nx0 = -1.5\n", "3:6", "-|xs| = -1 and x0 = -1.5; permitted: a start between the stops"},
      {"[scene]\nstop_lower = 0.5\nstop_upper = 1\n", "2:14", "stop_lower = 0.5 and x0 = 0"},
      {"[scene]\nstop_lower = -2\nstop_upper = -1\n", "3:14", "x0 = 0 and stop_upper = -1"},
      {"[scene]\nx0 = 0.5\n[sweep]\nxs = [1, -0.25, 2]\n", "2:6", "x0 = 0.5 and |xs| = 0.25"},
      {"[scene]\nxs = 1\n[sweep]\nx0 = [0, 1, 2]\n", "4:13", "x0 = 2 and |xs| = 1"},
      {"[sweep]\nxs = [2, 1]\nx0 = [1, 2]\nlinked = \"xs, x0\"\n", "3:10", "x0 = 2 and |xs| = 1"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, start_period_belongs_to_free_motion_between_symmetric_stops) {
  const std::string start = "[scene]\nxs = 1\nstart_period = 3\n";
  const std::vector<Wrong> table{
      {start + "h = 0.1\n", "4:5", "h = 0.1 beside 'start_period'; permitted: 0"},
      {start + "f = 1\n", "4:5", "f = 1 beside 'start_period'; permitted: 0"},
      {start + "load = 1\n", "4:8", "load = 1 beside 'start_period'"},
      {start + "R = 0.5\n", "4:5", "R = 0.5 beside 'start_period'; permitted: 1"},
      {start + "R_upper = 0.5\n", "4:11", "R_upper = 0.5 beside 'start_period'"},
      {start + "[sweep]\nh = [0, 0.1]\n", "5:9", "h = 0.1 beside 'start_period'"},
      {"[scene]\nstop_lower = -1\nstop_upper = 1\nstart_period = 3\n", "4:1", "'start_period' without 'xs'"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
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
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Together, sizes_are_bounded) {
  const std::string million = "\"linspace(1, 2, 1000000)\"\n";
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\n[sweep]\nnu = " + million + "f = " + million, "5:5",
       "a sweep of 1e+12 points; permitted: at most 1e+09"},
      {"[scene]\nxs = 1\n[observe]\nharmonics = 2048\n", "4:13", "less than half of harmonics_samples"},
      {"[scene]\nxs = 1\n[observe]\ntrajectory = 1\n", "4:14", "permitted: a whole number, 0 or 2 ... 1e7"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Later, keys_and_methods_of_later_issues_are_unknown_today) {
  const std::vector<Wrong> table{
      {"[scene]\nxs = 1\n[observe]\nstability = true\n", "4:1", "unknown key 'stability' in [observe]"},
      {"[scene]\nxs = 1\n[integrator]\neffects = \"all\"\n", "4:1", "unknown key 'effects' in [integrator]"},
      {"[scene]\nxs = 1\n[integrator]\nstep = 1e-3\n", "4:1", "unknown key 'step' in [integrator]"},
      {"[scene]\nxs = 1\n[integrator]\nmethod = \"dopri5\"\n", "4:10", "permitted: exact"},
  };
  expect_all("a.toml", table);
  expect_all("a.ini", table);
}

TEST(Toml, syntax_errors_have_a_place) {
  expect_all("a.toml",
             {
                 {"[scene]\nh = \n", "2:5", "expected value"},
                 {"[scene]\nh 1\n", "2:3", "expected '='"},
                 {"[scene\nh = 1\n", "1:7", "expected ']'"},
                 {"[scene]\nnu = linspace(1, 2, 3)\n", "2:6", "expressions stand in quotes"},
                 {"[scene]\nh = 2*pi\n", "2:6", "expressions stand in quotes"},
                 {"[scene]\nh = 1e400\n", "2:5", "1e400"},
                 {"[scene]\nh = 99999999999999999999\n", "2:5", "the number is too large"},
                 {"[scene]\nh = 1\n[scene]\nf = 1\n", "3:1", "each section and each key is given once"},
                 {"title = \"\\q\"\n", "1:11", "unknown escape sequence"},
                 {"[scene]\nh = 0.1 0.2\n", "2:9", "KEY = VALUE"},
                 {"[scene]\nh = .5\n", "2:5", "expected decimal digit"},
                           {"[observe]\nextrema = t\n", "2:12", "expected 'true', saw 't?'"},
                 {"scene = 5\n", "1:1", "unknown key 'scene' before the first section; begin the section with [scene]"},
                 {"[[scene]]\nxs = 1\n", "1:3", "begin the section with [scene]"},
                 {"[scene]\nxs = 1\n[scene.nu]\na = 1\n", "3:1", "nu = a table"},
                 {"[time]\nmax_period = 1\n", "2:1", "did you mean 'max_periods'?"},
                 {"[Scene]\nxs = 1\n", "1:2", "unknown section [Scene]; did you mean [scene]?"},
                 {"[physics]\n", "1:2", "permitted: scene, sweep, time, observe, integrator, output"},
                 {"[scene]\nxs = 1\ntitle = \"a\"\n", "3:1", "it belongs before the first section"},
                 {"[scene]\nxs = 1\nnu = \"2 * pie\"\n", "3:13", "expected the end of the value, found 'e'"},
                 {"[scene]\nxs = 1\nx0 = \"ä*pi\"\n", "3:7", "expected a number"},
                 {"[scene]\nxs = 1\x01\n", "2:7", "a control character"},
                 {"title = \"ä\" x\n", "1:13", ""},
                 {"[time]\nmode = \"stedy\"\n", "2:8", "did you mean 'steady'?"},
                 {"[scene]\nxs = 1\n[sweep]\nnu = [1, [2]]\n", "4:10", "nu = a list"},
             });
}

TEST(Ini, syntax_errors_have_a_place) {
  expect_all("a.ini",
             {
                 {"[scene]\nh = \n", "2:4", "h = nothing; permitted: >= 0"},
                 {"[scene]\n  h 1\n", "2:3", "expected KEY = VALUE or [section], found 'h 1'"},
                 {"[scene\nh = 1\n", "1:1", "the section's ']' is missing"},
                 {"[]\nh = 1\n", "1:1", "a section without a name"},
                 {"[scene] h = 1\n", "1:9", "begin a new line"},
                 {"[scene]\nxs = 1\n[time]\n[ scene ]\nf = 1\n", "4:3", "section [scene] again; it began at line 1"},
                 {"[scene]\nf = 1\n\n f = 2\n", "4:2", "key 'f' again; it was given at line 2"},
                 {"[scene]\n = 1\n", "2:2", "a key is missing before '='"},
                 {"[scene]\nh # = 1\n", "2:1", "expected KEY = VALUE"},
                 {"title = \"a\n", "1:9", "the closing quote is missing"},
                 {"title = \"a\" b\n", "1:13", "text after the closing quote"},
                 {"[scene]\nnu = 0.5, x\n", "2:9", ""},
                 {"[scene]\r\nxs = 1\r\nnuu = 1\r\n", "3:1", "did you mean 'nu'?"},
                 {"\xEF\xBB\xBF[scen]\n", "1:2", "unknown section [scen]; did you mean [scene]?"},
                 {"title = ü\n[scene]\nxs = ü\n", "3:6", "expected a number"},
                 {"title = ü\x02\n", "1:10", "a control character"},
                 {"h = 1\n", "1:1", "unknown key 'h' before the first section; it belongs in [scene]"},
                 {"[time]\nmode = stedy\n", "2:8", "did you mean 'steady'?"},
                 {"[time]\nmax_periods = 1_000\n", "2:16", "expected the end of the value"},
             });
}

TEST(Ini, comments_and_quotes_are_told_from_text) {
  const Config config =
      read_as("a.ini", "title = 'a # b; c' ; d\nsource = http://x.org/#a;b # c\n[scene] ; e\nxs = 1;f\n#g\n;h = 1\n");
  EXPECT_EQ(config.title, "a # b; c");
  EXPECT_EQ(config.source, "http://x.org/#a;b");
}

}  // namespace
}  // namespace clatter
