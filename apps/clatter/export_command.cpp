#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "commands.hpp"
#include "common_options.hpp"
#include "config/config.hpp"
#include "config/suggestion.hpp"
#include "config/value_grammar.hpp"
#include "results/csv_table.hpp"
#include "results/dataset_file.hpp"
#include "storage/atomic_write.hpp"
#include "storage/error.hpp"
#include "storage/utf8.hpp"

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

std::pair<std::string, double> place(const std::string& text) {
  const std::size_t equals = text.find('=');
  try {
    if (equals == std::string::npos || equals == 0) throw UsageError("");
    const double value = config::parse_number({std::string_view(text).substr(equals + 1), {}});
    return {text.substr(0, equals), value};
  } catch (const std::runtime_error&) {
    throw UsageError("--where " + config::in_quotes(text) + "; expected AXIS=VALUE, e.g. nu=1.0");
  }
}

results::TableChoice choice_of(const Arguments& arguments) {
  results::TableChoice choice{.only = listed(arguments.values("only")), .impacts = arguments.has("impacts")};
  for (const std::string& text : arguments.values("where")) choice.where.push_back(place(text));
  return choice;
}

void check_output(const Arguments& arguments, const std::string& output) {
  storage::check_writable(output);
  std::error_code error;
  if (std::filesystem::equivalent(arguments.operands[0], output, error))
    throw UsageError("the output " + storage::quoted_name(output) + " is the input; name another file with -o");
  if (std::filesystem::exists(output, error) && !arguments.has("force"))
    throw storage::IoError("cannot write " + storage::quoted_name(output) +
                           ": there is a file; name another with -o, move that one away, or replace it with --force");
}

int export_table(const Arguments& arguments) try {
  const std::string& path = arguments.operands[0];
  const results::TableChoice choice = choice_of(arguments);
  const std::optional<std::string> output =
      arguments.value("output").value_or("-") == "-" ? std::nullopt : arguments.value("output");
  if (output) check_output(arguments, *output);
  const results::FileSummary summary = results::read_summary(path);
  const results::CsvTable table(summary, path, choice);
  const sweep::Dataset dataset = results::read_variables(path, table.variables());
  if (!output) {
    table.write(dataset,
                [](std::string_view text) { std::cout.write(text.data(), static_cast<std::streamsize>(text.size())); });
    return done;
  }
  std::string text;
  table.write(dataset, [&](std::string_view more) { text += more; });
  storage::write_atomically(*output, std::as_bytes(std::span(text)));
  return done;
} catch (const results::ChoiceError& error) {
  throw UsageError(error.what());
}

constexpr std::string_view examples =
    "  clatter export fig22.h5 > fig22.csv\n"
    "  clatter export map.h5 --only x_max,v_before[-1] --where nu=1.0 -o part.csv\n"
    "  clatter export fig18.h5 --impacts\n";

}  // namespace

Command export_command() {
  return {.name = "export",
          .usage = "export FILE.h5 [OPTION]...",
          .summary = "print an output file as CSV for gnuplot, R and spreadsheets",
          .examples = examples,
          .operands = {"FILE.h5"},
          .required_operands = 1,
          .options = {{"only", 0, "NAME,...", "columns of these results, or components like v_before[-1]; repeatable",
                       true},
                      {"where", 0, "AXIS=VALUE", "rows at this value of an axis; repeatable", true},
                      {"impacts", 0, "", "a row for each impact of the log; default: for each point"},
                      {"output", 'o', "FILE.csv", "output file; default: standard output"},
                      force_option,
                      {"help", 'h', "", "print this help"}},
          .run = export_table};
}

}  // namespace clatter::app
