#include "config/reference.hpp"

#include <gtest/gtest.h>

#include "config/settings.hpp"
#include "config/wrapped.hpp"
#include "config/written_config.hpp"

namespace clatter::config::reference_test {
namespace {

/// The configuration of an example, with stops if it has none and no loose mass, and something observed.
Config config_of(const std::string& example) {
  std::vector<Override> changes{{"observe.extrema", "true"}};
  const bool stops = example.find("xs =") != std::string::npos || example.find("stop_") != std::string::npos ||
                     example.find("gap =") != std::string::npos || example.find("loose_") != std::string::npos;
  if (!stops) changes.push_back({"scene.xs", "1"});
  return read_as("a.toml", example, changes);
}

void expect_effective(const Config& config) {
  for (const Warning& warning : config.warnings) ADD_FAILURE() << warning.location << ": " << warning.text;
}

TEST(Examples, of_every_key_are_configurations_in_which_it_has_an_effect) {
  for (const Key& key : keys()) {
    expect_effective(config_of(key_example(key)));
    if (!describes_scene(key.section) || key.kind != Kind::number) continue;
    const Config config = config_of(axis_example(key));
    expect_effective(config);
    EXPECT_EQ(size(config.sweep), 11u) << key.name;
  }
}

TEST(Examples, show_something_else_than_the_default) {
  for (const Key& key : keys()) {
    if (key.fallback.empty()) continue;
    EXPECT_NE(example_setting(key).value, default_setting(key).value) << key.section << '.' << key.name;
  }
}

TEST(Reference, names_every_key_once_with_its_meaning) {
  const std::string text = configuration_reference();
  for (const Key& key : keys()) {
    const std::string of_section = section_reference(key.section), name = "\n  " + std::string(key.name);
    EXPECT_TRUE(of_section.find(name + ' ') != std::string::npos || of_section.find(name + '\n') != std::string::npos)
        << key.name;
    EXPECT_NE(text.find(of_section), std::string::npos) << key.section;
  }
}

TEST(Wrapped, breaks_at_blanks_before_the_81st_column) {
  const std::string words(79, 'a');
  EXPECT_EQ(wrapped("", 2), "\n");
  EXPECT_EQ(wrapped(words + " b", 0), words + "\nb\n");
  EXPECT_EQ(wrapped(words + "a b", 0), words + "a\nb\n");
  EXPECT_EQ(wrapped(words.substr(2) + " b c", 2), words.substr(2) + "\n  b c\n");
  EXPECT_EQ(wrapped("b " + words, "# "), "b\n# " + words + "\n");  // a word longer than a line is left whole
}

}  // namespace
}  // namespace clatter::config::reference_test
