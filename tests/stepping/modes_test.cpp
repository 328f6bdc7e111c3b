#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "stepping/exact.hpp"

namespace clatter::stepping::modes_test {
namespace {

constexpr std::array<const char*, 5> searched_as{"gaps", "margins", "pull", "series", "closed form"};

/// The rows of some modes, as lines of the guide's table.
template <class... Modes>
struct Lines {
  [[nodiscard]] static std::vector<std::string> all() { return {line(Modes::row)...}; }

  [[nodiscard]] static std::string line(const Row& row) {
    std::ostringstream text;
    text << "| " << row.mode << " | " << row.oscillator << " | " << row.guards << " | "
         << searched_as[static_cast<std::size_t>(row.search)] << " | " << row.laws << " |";
    return text.str();
  }
};

/// The rows of a table of the guide, by the name of its first column.
std::vector<std::string> rows_of(const std::string& table) {
  std::ifstream guide(std::string(CLATTER_SOURCE) + "/src/stepping/README.md");
  std::vector<std::string> lines;
  bool is_there = false;
  for (std::string line; std::getline(guide, line);) {
    if (line.starts_with("| " + table + " |"))
      is_there = true, std::getline(guide, line);
    else if (is_there && !line.starts_with('|'))
      break;
    else if (is_there)
      lines.push_back(line);
  }
  return lines;
}

/// The names of the modes that a set of effects calls for.
template <class... Modes>
std::vector<std::string> names(std::tuple<std::type_identity<Modes>...>) {
  return {std::string(Modes::row.mode)...};
}
template <Effects E>
std::vector<std::string> called_for() {
  return names(Modes<Exact<double, E>>());
}

TEST(Modes, ReadAsTheTableOfTheGuide) {
  EXPECT_EQ(rows_of("mode"), (Table<Lines, Exact<double, Effects{}>>::all()));
  EXPECT_EQ(rows_of("loose mass"),
            (std::vector{Lines<>::line(flying_row), Lines<>::line(sliding_row), Lines<>::line(pressed_row),
                         Lines<>::line(stuck_row), Lines<>::line(in_wall_row), Lines<>::line(beyond_wall_row)}));
}

TEST(Modes, AreThoseThatTheEffectsCallFor) {
  constexpr Effects rigid{.lower = true, .upper = true, .rest = true};
  using Names = std::vector<std::string>;
  EXPECT_EQ(called_for<rigid>(), (Names{"in chatter", "at rest", "between stops"}));
  constexpr Effects elastic{.lower = true, .upper = true};
  EXPECT_EQ(called_for<elastic>(), (Names{"between stops"}));
  constexpr Effects loose{.loose = true};
  EXPECT_EQ(called_for<loose>(), (Names{"between stops"}));
  constexpr Effects loose_between_stops{.lower = true, .upper = true, .rest = true, .loose = true};
  EXPECT_EQ(called_for<loose_between_stops>(), (Names{"at rest", "between stops"}));
  constexpr Effects soft{.lower = true, .upper = true, .soft = true};
  EXPECT_EQ(called_for<soft>(), (Names{"beyond a stop", "in contact", "between stops"}));
}

}  // namespace
}  // namespace clatter::stepping::modes_test
