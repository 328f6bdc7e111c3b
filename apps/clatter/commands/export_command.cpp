#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "config/config.hpp"
#include "config/suggestion.hpp"
#include "outputs/output_summary.hpp"
#include "results/dataset_file.hpp"
#include "storage/atomic_write.hpp"
#include "tables/csv_table.hpp"
#include "terminal/common_options.hpp"
#include "terminal/table_options.hpp"

namespace clatter::app {
namespace {

/// The words between the commas of all values of an option.
std::vector<std::string> listed(const std::vector<std::string>& values) {
  std::vector<std::string> words;
  for (const std::string& value : values) {
    for (std::size_t begin = 0; begin <= value.size();) {
      const std::size_t end = std::min(value.find(',', begin), value.size());
      words.push_back(value.substr(begin, end - begin));
      if (words.back().empty())
        throw UsageError("--only " + config::in_quotes(value) + " has an empty name; write e.g. --only x_max,status");
      begin = end + 1;
    }
  }
  return words;
}

TableRows rows_of(const Arguments& arguments) {
  TableRows rows = TableRows::points;
  std::string chosen;
  for (const auto& [option, own] :
       {std::pair("impacts", TableRows::impacts), std::pair("samples", TableRows::samples),
        std::pair("motions", TableRows::motions), std::pair("special", TableRows::special)}) {
    if (!arguments.has(option)) continue;
    if (!chosen.empty()) throw UsageError("--" + chosen + " conflicts with --" + option + "; give one of them");
    chosen = option, rows = own;
  }
  return rows;
}

TableChoice choice_of(const Arguments& arguments) {
  return {.only = listed(arguments.values("only")), .where = conditions_of(arguments), .rows = rows_of(arguments)};
}

int export_table(const Arguments& arguments) try {
  const std::string& path = arguments.operands[0];
  const TableChoice choice = choice_of(arguments);
  const std::optional<std::string> output = text_output_of(arguments, FileKind::table);
  const results::FileSummary summary = outputs::read_summary(path);
  const CsvTable table(summary, path, choice);
  const results::Dataset dataset = results::read_variables(path, table.variables());
  if (!output) {
    table.write(dataset,
                [](std::string_view text) { std::cout.write(text.data(), static_cast<std::streamsize>(text.size())); });
    return done;
  }
  std::string text;
  table.write(dataset, [&](std::string_view more) { text += more; });
  storage::write_atomically(*output, text);
  return done;
} catch (const ChoiceError& error) {
  throw UsageError(error.what());
}

constexpr std::string_view export_notes =
    "Numbers are those of the file: work, losses and impulse in the observed time, which `clatter info` and pictures "
    "give per forcing period. tau of samples and of impacts is the time since the observed time began, in s of a "
    "[machine], else in units of one over the natural frequency, so that a forcing period is 2 pi/nu. A result has one "
    "name for --only and --where in all rows, e.g. word; the names in the file, impact_word or special_word, are "
    "understood, too.";

constexpr std::string_view export_examples =
    "  clatter export fig22.h5 > fig22.csv\n"
    "  clatter export map.h5 --only x_max,v_before[-1] --where nu=1.0 -o part.csv\n"
    "  clatter export drive.h5 --where gap='1.5 mm'\n"
    "  clatter export map.h5 --where 'impact_speed < 0.4' --where word=LU\n"
    "  clatter export fig18.h5 --impacts\n"
    "  clatter export basins.h5 --motions --only word,share\n"
    "  clatter export curve.branch.h5 --special --where kind=fold\n";

}  // namespace

Command export_command() {
  return {.name = "export",
          .usage = "export FILE.h5 [OPTION]...",
          .summary = "print an output file as CSV for gnuplot, R and spreadsheets",
          .examples = export_examples,
          .notes = export_notes,
          .operands = {"FILE.h5"},
          .required_operands = 1,
          .options = {{"only", 0, "NAME,...", "columns of these results, or components like v_before[-1]; repeatable",
                       true},
                      where_option,
                      {"impacts", 0, "", "one row for each logged impact instead of one for each point"},
                      {"samples", 0, "", "one row for each sample of the trajectories: tau, x, v, ..."},
                      {"motions", 0, "", "one row for each motion that starts end in, with its share"},
                      {"special", 0, "", "one row for each special point of branches instead of one for each point"},
                      {"output", 'o', "FILE.csv", "output file; default: standard output"},
                      force_option,
                      {"help", 'h', "", "print this help"}},
          .run = export_table};
}

}  // namespace clatter::app
