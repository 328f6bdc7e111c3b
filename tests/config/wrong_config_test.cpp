#include <gtest/gtest.h>

#include <cmath>

#include "config/keys.hpp"
#include "config/value_grammar.hpp"
#include "config/written_config.hpp"

namespace clatter::config::wrong_config_test {
namespace {

/// A configuration that is right but for its fourth line, which stands in the section.
std::string config_with(std::string_view section, const std::string& line) {
  const std::string stops = line.starts_with("xs") ? "h = 0.1\n" : "xs = 4.0\n";
  if (section.empty()) return "\n\n\n" + line + "\n[scene]\n" + stops;
  if (section == "scene") return "\n[scene]\n" + stops + line + '\n';
  if (section == "machine")
    return "\n[machine]\n" + std::string(line.starts_with("mass") ? "gap = 1\n" : "mass = 1\n") + line + '\n';
  return "[scene]\n" + stops + '[' + std::string(section) + "]\n" + line + '\n';
}

/// The mistake in line 4 must be found at a column, in TOML and in INI, with these words.
void expect_mistake(const Key& key, const std::string& section, const std::string& line, int column,
                    const std::string& words, std::string_view formats = "both") {
  for (const std::string name : {"a.toml", "a.ini"}) {
    if (formats != "both" && !name.ends_with(formats)) continue;
    const std::string mistake = mistake_in(name, config_with(section, line));
    const std::string location = name + ":4:" + std::to_string(column) + ": ";
    EXPECT_TRUE(mistake.starts_with(location))
        << key.name << ": " << line << "\ngave " << mistake << "\nnot at " << location;
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

TEST(EveryKey, of_the_wrong_kind_says_what_is_expected) {
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
      expect_wrong_value(key, "[1]", words, "ini");
    } else if (key.kind == Kind::flag) {
      for (const char* value : {"1", "yes", "True"}) expect_wrong_value(key, value, words, "ini");
      for (const char* value : {"1", "\"true\"", "0.0", "[true]"}) expect_wrong_value(key, value, words, "toml");
    } else if (key.kind == Kind::interval) {
      for (const char* value : {"1", "true", "\"a\"", "[1]", "[2, 1]", "[1, 1]", "[1, 2, 3]", "[1, inf]"})
        expect_wrong_value(key, value, words, "toml");
      for (const char* value : {"1", "2, 1", "1, 2, 3"}) expect_wrong_value(key, value, words, "ini");
    } else if (key.kind == Kind::choices) {
      for (const char* value : {"1", "true", "\"a\"", "\"\""}) expect_wrong_value(key, value, words, "toml");
      for (const char* value : {"a", "[a]", "none, none"}) expect_wrong_value(key, value, words, "ini");
      const std::string in_list = std::string(key.name) + " = [\"a\"]";
      expect_mistake(key, std::string(key.section), in_list, static_cast<int>(key.name.size()) + 5, words, "toml");
    } else {
      for (const char* value : {"1", "true"}) expect_wrong_value(key, value, words, "toml");
      if (key.kind == Kind::text) expect_wrong_value(key, "[\"a\"]", words, "toml");
    }
    if (key.kind == Kind::choice) expect_wrong_value(key, "\"?\"", words);
    if (key.kind == Kind::names && key.section == "sweep") expect_wrong_value(key, "\"nu\"", "is no axis of [sweep]");
    if (key.kind == Kind::names && key.section != "sweep") expect_wrong_value(key, "\"?\"", "is no key of [scene]");
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
      if (!is_stop) expect_wrong_value(key, value, "expected " + permitted(key));
    }
    expect_wrong_value(key, "1e999", "", "ini");
  }
}

TEST(EveryNumber, out_of_its_range_is_refused_with_the_range) {
  int bounded = 0;
  for (const Key& key : keys()) {
    if (!is_numeric(key)) continue;
    const AllowedRange& range = key.range;
    const std::string words = "out of range; expected " + permitted(key);
    if (range.not_zero) expect_wrong_value(key, "0", words);
    if (std::isfinite(range.low)) expect_wrong_value(key, "-1", words);
    if (std::isfinite(range.low) && range.open && !range.or_zero)
      expect_wrong_value(key, number_text(range.low), words);
    if (std::isfinite(range.high)) expect_wrong_value(key, toml_number(range.high * 2 + 1), words);
    if (std::isfinite(range.high) && range.open) expect_wrong_value(key, toml_number(range.high), words);
    bounded += range.not_zero || std::isfinite(range.low) ? 1 : 0;
  }
  EXPECT_GE(bounded, 16);  // all but f, phase, load, x0, v0 and the stops
}

TEST(Integrator, misspelt_methods_are_told_the_nearest) {
  const Key& method = *find_key("integrator", "method");
  for (const auto& [typo, meant] : {std::pair{"exactt", "exact"},
                                    {"dopri", "dopri5"},
                                    {"dopri54", "dopri5"},
                                    {"moraeu", "moreau"},
                                    {"Moreau", "moreau"}}) {
    const std::string words = "expected one of exact, dopri5, moreau; did you mean '" + std::string(meant) + "'?";
    expect_wrong_value(method, '"' + std::string(typo) + '"', words);
  }
  expect_wrong_value(method, "\"rk4\"", "the text 'rk4'; expected one of exact, dopri5, moreau");
}

TEST(Integrator, settings_that_cannot_converge_are_refused) {
  const struct {
    const char *name, *value, *range;
  } table[] = {
      {"tolerance", "0", "1e-14 ... 0.1"},
      {"tolerance", "1", "1e-14 ... 0.1"},
      {"tolerance", "1e-15", "1e-14 ... 0.1"},
      {"tolerance", "0.2", "1e-14 ... 0.1"},
      {"step", "0", "1e-9 ... 1"},
      {"step", "1e-10", "1e-9 ... 1"},
      {"step", "1.5", "1e-9 ... 1"},
      {"theta", "2", "0 ... 1"},
      {"theta", "-0.5", "0 ... 1"},
  };
  for (const auto& [name, value, range] : table)
    expect_wrong_value(*find_key("integrator", name), value, " is out of range; expected " + std::string(range));
}

TEST(Integrator, settings_within_their_ranges_are_taken) {
  const auto integrator = [](const std::string& lines) { return "[scene]\nxs = 1\n[integrator]\n" + lines; };
  for (const std::string name : {"a.toml", "a.ini"}) {
    const stepping::Integration taken =
        read_as(name, integrator("method = \"moreau\"\nstep = 1\ntheta = 0\ntolerance = 0.1\n"))
            .sweep.problem.integration;
    EXPECT_EQ(taken.method, stepping::Method::moreau);
    EXPECT_EQ(taken.step, 1.0);
    EXPECT_EQ(taken.theta, 0.0);
    EXPECT_EQ(taken.tolerance, 0.1);
    EXPECT_EQ(read_as(name, integrator("method = \"dopri5\"\n")).sweep.problem.integration.method,
              stepping::Method::dopri5);
    EXPECT_EQ(read_as(name, integrator("")).sweep.problem.integration.method, stepping::Method::exact);
  }
}

TEST(EveryCount, that_is_a_fraction_is_refused) {
  for (const Key& key : keys()) {
    if (key.kind == Kind::integer) expect_wrong_value(key, "2.5", "2.5 is a fraction; expected a whole number");
  }
}

TEST(EveryText, with_a_nul_is_refused_since_a_file_ends_it_there) {
  for (const Key& key : keys()) {
    if (key.kind == Kind::text) expect_wrong_value(key, "\"a\\u0000b\"", "holds a NUL character", "toml");
  }
}

TEST(EveryAxis, of_a_text_is_refused_with_the_reason) {
  for (const Key& key : keys())
    if (describes_scene(key.section) && key.kind == Kind::text) {
      const std::string name(key.name), axis = "[sweep]\n" + name + " = [0.5, 0.6]\n";
      const std::string found = mistake_in("a.toml", axis);
      EXPECT_NE(found.find(name + " is a text, and an axis has numbers"), std::string::npos) << found;
    }
}

TEST(EveryAxis, is_checked_like_the_scene) {
  for (const Key& key : keys()) {
    if (key.section != "scene" || key.kind != Kind::number) continue;
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

}  // namespace
}  // namespace clatter::config::wrong_config_test
