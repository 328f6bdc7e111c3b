#include "io/reference.hpp"

#include <gtest/gtest.h>

#include "io/settings.hpp"
#include "io/wrapped.hpp"
#include "io/written_config.hpp"

namespace clatter {
namespace {

/// A configuration of an example, with stops where it has none.
std::vector<Override> stops_for(const std::string& example) {
  const bool given = example.find("xs =") != std::string::npos || example.find("stop_") != std::string::npos;
  return given ? std::vector<Override>{} : std::vector<Override>{{"scene.xs", "1"}};
}

TEST(Examples, of_every_key_are_configurations) {
  for (const Key& key : keys()) {
    const std::string example = key_example(key);
    EXPECT_EQ(mistake_in("a.toml", example, stops_for(example)), "") << example;
    if (key.section != "scene") continue;
    const std::string axis = axis_example(key);
    EXPECT_EQ(mistake_in("a.toml", axis, stops_for(axis)), "") << axis;
    EXPECT_EQ(size(read_as("a.toml", axis, stops_for(axis)).sweep), 11u) << axis;
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
    const std::string name = "\n  " + std::string(key.name) + ' ';
    EXPECT_NE(section_reference(key.section).find(name), std::string::npos) << key.name;
    EXPECT_NE(text.find(section_reference(key.section)), std::string::npos) << key.section;
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
}  // namespace clatter
