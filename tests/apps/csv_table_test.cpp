#include "tables/csv_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "storage/error.hpp"
#include "support/random.hpp"
#include "tables/csv_text.hpp"

namespace clatter::app::csv_table_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// Two frequencies, each with its own f, by two restitutions; two harmonics, and a log of three impacts.
const results::Dataset dataset{
    {{"nu", 2}, {"R", 2}, {"harmonic", 2}, {"impact", 3}},
    {{"nu", {"nu"}, std::vector<double>{0.5, 1.0}, "frequency", "1"},
     {"f", {"nu"}, std::vector<double>{-1.0, -2.0}, "force", "1"},
     {"R", {"R"}, std::vector<double>{0.3, 0.7}, "restitution", "1"},
     {"harmonic", {"harmonic"}, std::vector<std::int64_t>{0, 1}, "order", "1"},
     {"status",
      {"nu", "R"},
      std::vector<std::uint8_t>{0, 1, 0, 16},
      "outcome",
      "1",
      {{"flag_values", std::vector<std::uint8_t>{0, 1, 16}}, {"flag_meanings", "periodic aperiodic event_budget"}}},
     {"x_max", {"nu", "R"}, std::vector<double>{0.1, nan, -0.0, infinity}, "maximum", "1"},
     {"x_phase", {"nu", "R", "harmonic"}, std::vector<double>{0, 0.1, 1, 1.1, 2, 2.1, 3, 3.1}, "phase", "rad"},
     {"impact_word", {"nu", "R"}, std::vector<std::string>{"LU", "", "L,U", "L\"U"}, "word", "1"},
     {"impact_count", {"nu", "R"}, std::vector<std::int64_t>{1, 0, 2, 0}, "impacts", "1"},
     {"impact_tau", {"impact"}, std::vector<double>{0.5, 1.5, 2.5}, "time", "1"}}};

results::FileSummary summary_of(const results::Dataset& data) {
  results::FileSummary summary;
  summary.attributes = {{"title", "Two\nlines"}};
  for (const results::Variable& variable : data.variables) {
    results::FileSummary::Entry entry{variable.name, "float64", variable.units, variable.long_name, {}};
    for (const std::string& name : variable.dimensions)
      entry.dimensions.push_back(*std::ranges::find(data.dimensions, name, &results::NamedLength::name));
    summary.variables.push_back(entry);
  }
  return summary;
}

/// The lines of the table that are no comments.
std::string table(const TableChoice& choice, const results::Dataset& data = dataset) {
  const results::FileSummary summary = summary_of(dataset);
  std::string text, rows;
  CsvTable(summary, "a.h5", choice).write(data, [&](std::string_view more) { text += more; });
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    if (text[begin] != '#') rows += text.substr(begin, end - begin);
    begin = end;
  }
  return rows;
}

std::string refusal(const TableChoice& choice) {
  try {
    (void)table(choice);
    return "";
  } catch (const ChoiceError& error) {
    return error.what();
  }
}

TEST(CsvTable, has_axes_then_numbers_by_component_then_texts_then_words_of_flags) {
  EXPECT_EQ(table({}),
            "nu,f,R,x_max,x_phase[0],x_phase[1],impact_count,impact_word,status\n"
            "0.5,-1,0.3,0.1,0,0.1,1,LU,periodic\n"
            "0.5,-1,0.7,nan,1,1.1,0,,aperiodic\n"
            "1,-2,0.3,-0,2,2.1,2,\"L,U\",periodic\n"
            "1,-2,0.7,inf,3,3.1,0,\"L\"\"U\",event_budget\n");
}

TEST(CsvTable, tells_title_units_and_meanings_in_lines_of_their_own) {
  const results::FileSummary summary = summary_of(dataset);
  std::string text;
  CsvTable(summary, "a.h5", {.only = {"x_phase"}}).write(dataset, [&](std::string_view more) { text += more; });
  EXPECT_TRUE(
      text.starts_with("# title: Two\\x0alines\n# nu (1): frequency\n# f (1): force\n# R (1): restitution\n"
                       "# x_phase (rad): phase\nnu,"))
      << text;
}

TEST(CsvTable, may_have_some_columns_and_rows) {
  EXPECT_EQ(table({.only = {"x_phase[1]", "x_max"}, .where = {condition_of("R=0.7")}}),
            "nu,f,R,x_max,x_phase[1]\n0.5,-1,0.7,nan,1.1\n1,-2,0.7,inf,3.1\n");
  EXPECT_EQ(table({.only = {"status"}, .where = {condition_of("f=-2"), condition_of("R=0.300000000001")}}),
            "nu,f,R,status\n1,-2,0.3,periodic\n");
}

TEST(CsvTable, may_have_a_row_for_each_impact) {
  EXPECT_EQ(table({.rows = TableRows::impacts}), "nu,f,R,impact_tau\n0.5,-1,0.3,0.5\n1,-2,0.3,1.5\n1,-2,0.3,2.5\n");
  EXPECT_EQ(table({.where = {condition_of("nu=1")}, .rows = TableRows::impacts}),
            "nu,f,R,impact_tau\n1,-2,0.3,1.5\n1,-2,0.3,2.5\n");
}

TEST(CsvTable, refuses_what_the_file_does_not_have) {
  EXPECT_EQ(refusal({.only = {"x_maxx"}}), "--only: 'x_maxx' is no column of 'a.h5'; did you mean 'x_max'?");
  EXPECT_EQ(refusal({.only = {"x_phase[7]"}}),
            "--only: 'x_phase[7]' is no component; there are x_phase[0], x_phase[1]");
  EXPECT_EQ(refusal({.where = {condition_of("xs=1")}}),
            "--where: 'xs' is neither an axis nor a result of 'a.h5'; its axes are nu, f, R");
  EXPECT_EQ(refusal({.where = {condition_of("nu=0.8")}}),
            "--where nu=0.8: the axis has no such value; the nearest are 1 and 0.5");
}

TEST(CsvTable, refuses_a_file_that_contradicts_itself) {
  results::Dataset other = dataset;
  std::get<std::vector<double>>(other.variables[5].values).pop_back();
  EXPECT_THROW(table({}, other), storage::IoError);
  other = dataset;
  std::get<std::vector<std::int64_t>>(other.variables[8].values)[0] = 7;  // more impacts than the log has
  EXPECT_THROW(table({.rows = TableRows::impacts}, other), storage::IoError);
  std::get<std::vector<std::int64_t>>(other.variables[8].values)[0] = -1;
  EXPECT_THROW(table({.rows = TableRows::impacts}, other), storage::IoError);
}

TEST(CsvText, numbers_read_back_to_the_same_bits) {
  support::Random random(2, 0);
  for (int i = 0; i < 2000; ++i) {
    const double value = random.sign() * random.logarithmic(1e-300, 1e300);
    std::string text;
    append_number(text, value);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
    EXPECT_LE(text.size(), 24u);
  }
}

}  // namespace
}  // namespace clatter::app::csv_table_test
