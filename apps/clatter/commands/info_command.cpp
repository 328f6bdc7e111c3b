#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <optional>

#include "answers/extremes.hpp"
#include "answers/extremes_report.hpp"
#include "answers/per_period.hpp"
#include "answers/quantiles.hpp"
#include "answers/ranges_report.hpp"
#include "answers/refined_ranges.hpp"
#include "answers/told_motions.hpp"
#include "commands/commands.hpp"
#include "config/keys.hpp"
#include "config/wrapped.hpp"
#include "help/result_catalogue.hpp"
#include "help/result_help.hpp"
#include "outputs/output_summary.hpp"
#include "results/dataset_file.hpp"
#include "storage/error.hpp"
#include "storage/utf8.hpp"
#include "tables/file_points.hpp"
#include "tables/json_output.hpp"
#include "terminal/asked_units.hpp"
#include "terminal/table_options.hpp"

namespace clatter::app {
namespace {

std::string column(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text + "  ";
}

std::string shape_text(const results::FileSummary::Entry& entry) {
  std::string text;
  for (const results::NamedLength& dimension : entry.dimensions) {
    text += (text.empty() ? "[" : ", ") + dimension.name + " = " + std::to_string(dimension.length);
  }
  return text.empty() ? "scalar" : text + ']';
}

/// What the help knows beside the meaning of a variable; of a parameter, what the key is.
std::string note_on(std::string_view name, std::string_view command) {
  for (const CataloguedResult* const result : results_named(name))
    if (result->command == command) return result_note(*result);
  const auto key = std::ranges::find(config::keys(), name, &Key::name);
  return key == config::keys().end() ? std::string() : std::string(key->help);
}

void print_variables(const results::FileSummary& summary, bool with_notes) {
  std::size_t name_width = 0, shape_width = 0;
  for (const auto& entry : summary.variables) {
    name_width = std::max(name_width, entry.name.size());
    shape_width = std::max(shape_width, shape_text(entry).size());
  }
  for (const auto& entry : summary.variables) {
    const std::string unit = entry.units.empty() || entry.units == "1" ? "" : ", " + entry.units;
    std::cout << "  " << column(entry.name, name_width) << column(entry.type, 7)
              << column(shape_text(entry), shape_width) << entry.meaning() << unit << '\n';
    if (const std::string note = with_notes ? note_on(entry.name, command_of(summary)) : ""; !note.empty())
      std::cout << "      " << config::wrapped(note, 6);
  }
}

/// The summary with every text made printable, so that a terminal obeys none of it: the file may be anyone's.
results::FileSummary harmless(results::FileSummary summary) {
  const auto clean = [](std::string& text) { text = storage::printable(text); };
  for (auto& [name, value] : summary.attributes) clean(name), clean(value);
  for (results::FileSummary::Entry& entry : summary.variables) {
    for (std::string* const text : {&entry.name, &entry.type, &entry.units, &entry.long_name, &entry.frame})
      clean(*text);
    for (results::NamedLength& dimension : entry.dimensions) clean(dimension.name);
  }
  for (auto& [meaning, count] : summary.status_counts) clean(meaning);
  return summary;
}

/// Prints a summary for people; scripts use --json.
void print_text(const results::FileSummary& summary, const std::vector<Quantiles>& quantiles, bool with_notes,
                const AskedUnits& asked) {
  for (const auto& [name, value] : summary.attributes) {
    if (name != "config" && name != "scene_names") std::cout << column(name, 16) << value << '\n';
  }
  std::cout << "\nVariables\n";
  print_variables(summary, with_notes);
  if (!summary.status_counts.empty()) std::cout << "\nBy status\n";
  for (const auto& [meaning, count] : summary.status_counts) std::cout << "  " << column(meaning, 12) << count << '\n';
  std::cout << quantiles_text(summary, quantiles, asked);
}

/// Prints the configuration unchanged, so that it runs again; on a terminal control characters are made printable.
void print_config(const std::string& path, const results::FileSummary& summary) {
  const auto& attributes = summary.attributes;
  const auto config =
      std::find_if(attributes.begin(), attributes.end(), [](const auto& pair) { return pair.first == "config"; });
  if (config == attributes.end())
    throw storage::IoError(storage::quoted_name(path) + " holds no configuration; was it written by clatter?");
  std::cout << (::isatty(STDOUT_FILENO) != 0 ? storage::printable_lines(config->second) : config->second);
}

/// Prints the points at which a result is largest, or smallest.
void print_extremes(const results::FileSummary& summary, const std::string& path, const std::string& name,
                    const Arguments& arguments) {
  const Compared compared(summary, path);
  const Extremes extremes(compared.summary(), path, name, arguments.has("max"),
                          {.periodic = arguments.has("periodic"),
                           .where = conditions_of(arguments),
                           .for_axis = arguments.value("for").value_or("")});
  const std::vector<Extreme> points = extremes.of(compared.read(extremes.variables()));
  const AskedUnits asked(arguments.values("in"), summary, path);
  std::cout << (arguments.has("json") ? extremes_json(extremes, points) : extremes_text(extremes, points, asked));
}

/// Prints from where to where a result keeps its word, or points meet conditions.
void print_ranges(const results::FileSummary& summary, const std::string& path, const Arguments& arguments) {
  const Compared compared(summary, path);
  const Ranges ranges(compared.summary(), path,
                      {.result = arguments.value("ranges").value_or(""),
                       .where = conditions_of(arguments),
                       .along = arguments.value("along").value_or("")});
  const results::Dataset dataset = compared.read(ranges.variables());
  std::vector<RangeLine> lines = ranges.of(dataset);
  const std::optional<Met> met = arguments.has("where") ? std::optional(ranges.met(dataset)) : std::nullopt;
  if (arguments.has("refine")) refine(lines, ranges, summary, path);
  const AskedUnits asked(arguments.values("in"), summary, path);
  std::cout << (arguments.has("json") ? ranges_json(ranges, lines, met) : ranges_text(ranges, lines, met, asked));
}

/// The option that says what to print; empty: none. Only --json goes with others: with --max, --min and ranges.
std::string chosen_print(const Arguments& arguments) {
  std::string chosen;
  for (const char* const option : {"max", "min", "ranges", "json", "config", "check", "verbose"}) {
    const bool refines = std::string_view(option) == "json" && !chosen.empty();
    if (!arguments.has(option) || refines) continue;
    if (!chosen.empty()) throw UsageError("--" + chosen + " conflicts with --" + option + "; give one of them");
    chosen = option;
  }
  const bool asks_for_ranges = arguments.has("where") && (chosen.empty() || chosen == "json");
  return asks_for_ranges ? "ranges" : chosen;
}

/// Throws UsageError at an option that says nothing beside what is printed.
void require_use(const Arguments& arguments, const std::string& chosen) {
  const bool is_of_points = chosen == "max" || chosen == "min", is_of_ranges = chosen == "ranges";
  const auto need = [&](const char* option, bool holds, const std::string& way_out) {
    if (arguments.has(option) && !holds) throw UsageError("--" + std::string(option) + " without " + way_out);
  };
  need("periodic", is_of_points, "--max or --min; it chooses among their points");
  need("for", is_of_points, "--max or --min; it gives their points for each value of an axis");
  need("where", is_of_points || is_of_ranges, "--max, --min or --ranges, or alone; it chooses points");
  need("along", is_of_ranges, "--ranges or --where; it names the axis of their ranges");
  need("refine", is_of_ranges, "--ranges or --where; it sharpens the ends of their ranges");
  const bool is_for_people = !arguments.has("json") && chosen != "config" && chosen != "check";
  need("in", is_for_people, "text for people; JSON and configurations have the units of the file");
}

int print_info(const Arguments& arguments) try {
  const std::string chosen = chosen_print(arguments);
  require_use(arguments, chosen);
  const std::string& path = arguments.operands[0];
  const results::FileSummary summary = outputs::read_summary(path);
  if (chosen == "max" || chosen == "min") {
    print_extremes(summary, path, *arguments.value(chosen), arguments);
  } else if (chosen == "ranges") {
    print_ranges(summary, path, arguments);
  } else if (chosen == "check") {
    results::require_readable(summary, path);
  } else if (chosen == "config") {
    print_config(path, summary);
  } else if (chosen == "json") {
    std::cout << summary_json(summary, quantiles_of(summary, path), motions_of(summary, path));
  } else {
    const AskedUnits asked(arguments.values("in"), summary, path);
    print_text(harmless(summary), quantiles_of(summary, path), chosen == "verbose", asked);
    std::cout << motions_text(motions_of(summary, path), asked);
  }
  return done;
} catch (const ChoiceError& error) {
  throw UsageError(error.what());
}

constexpr std::string_view info_notes =
    "Work, losses and impulse are those of one forcing period here, as in pictures, so that points compare; the file "
    "and `clatter export` have those of the observed time.";

constexpr std::string_view info_examples =
    "  clatter info fig22.h5\n"
    "  clatter info fig22.h5 --max impact_speed\n"
    "  clatter info fig22.h5 --max impact_speed --periodic\n"
    "  clatter info map.h5 --max impact_speed --for xs --where 'nu < 1.2'\n"
    "  clatter info fig22.h5 --ranges word --refine\n"
    "  clatter info drive.h5 --where 'impact_speed < 0.4 m/s' --in rpm\n"
    "  clatter info fig22.h5 --config > again.toml\n"
    "  clatter info --check fig22.h5 && echo sound\n";

}  // namespace

Command info_command() {
  return {.name = "info",
          .usage = "info FILE.h5 [OPTION]...",
          .summary = "print the contents of an output file and how it was made",
          .examples = info_examples,
          .notes = info_notes,
          .operands = {"FILE.h5"},
          .required_operands = 1,
          .options = {{"max", 0, "NAME",
                       "print the five points at which this result, or component as v_before[-1], is largest"},
                      {"min", 0, "NAME", "print those at which it is smallest"},
                      {"periodic", 0, "", "with --max or --min: of points with periodic motion alone"},
                      {"for", 0, "AXIS", "with --max or --min: the best point for each value of this axis"},
                      {"ranges", 0, "NAME",
                       "print from where to where along an axis this result, a name or a count, stays the same"},
                      {"where", 0, "CONDITION",
                       "print the ranges and the share of points that meet this, e.g. 'impact_speed < 0.4 m/s' or "
                       "word=LU; with the others: of these points alone; repeatable",
                       true},
                      {"along", 0, "AXIS", "with --ranges or --where: the axis; default: the longest"},
                      {"refine", 0, "",
                       "with --ranges or --where: sharpen the ends by running the scene between the points"},
                      {"in", 0, "UNIT", "print numbers of its kind in this unit, e.g. rpm; repeatable", true},
                      {"verbose", 'v', "", "print also when each result is NaN, and what asks for it"},
                      {"json", 0, "", "print JSON, also of --max, --min, --ranges and --where"},
                      {"config", 0, "", "print the configuration that made the file, which can be run again"},
                      {"check", 0, "", "print nothing, but read all values: the exit code is 0 if none is damaged"},
                      {"help", 'h', "", "print this help"}},
          .run = print_info};
}

}  // namespace clatter::app
