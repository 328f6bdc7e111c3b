#include <functional>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/certificate_text.hpp"
#include "certificates/sample.hpp"
#include "certify/certified_branches.hpp"
#include "certify/certified_file.hpp"
#include "commands/commands.hpp"
#include "config/suggestion.hpp"
#include "results/origin.hpp"
#include "storage/atomic_write.hpp"
#include "storage/input_file.hpp"
#include "tables/csv_table.hpp"
#include "terminal/common_options.hpp"
#include "terminal/table_options.hpp"

namespace clatter::app {
namespace {

/// What became of the points of an output, and the instruction set that this machine lacks of it.
struct Outcome {
  certificates::Tally tally;
  std::string lacking{};
};

/// Certifies the points of an output of `clatter run` or `clatter branch`.
Outcome outcome_of(const std::string& path, const std::vector<Condition>& conditions, const std::optional<int>& count,
                   const std::function<void(std::string_view line)>& take) {
  const auto sample = count ? std::optional(static_cast<std::size_t>(*count)) : std::nullopt;
  const auto origin = results::origin_of(path);
  if (origin && origin->command == "accuracy")
    storage::refuse_reading(path, "holds what accuracy costs, not motions",
                            "name an output of `clatter run` or `clatter branch`");
  if (origin && origin->command == "branch") {
    if (!conditions.empty())
      throw UsageError("--where chooses points of a sweep, and a branch has no axis; use --sample");
    return {CertifiedBranches(path).certify(sample, take)};
  }
  const CertifiedFile file(path, conditions);
  return {file.certify(sample ? certificates::spread(file.points(), *sample) : file.points(), take), file.lacking()};
}

int certify(const Arguments& arguments) try {
  const auto conditions = conditions_of(arguments);
  const std::optional<int> sample = count_of(arguments, "sample");
  const std::optional<std::string> output = text_output_of(arguments, FileKind::certificates);
  std::string text;
  const auto write = [&](std::string_view line) {
    if (output)
      text += line;
    else
      std::cout.write(line.data(), static_cast<std::streamsize>(line.size()));
  };
  std::size_t count = 0;
  const auto take = [&](std::string_view line) {
    if (count++ == 0) write(certificates::list_begin());
    write(line);
  };
  const auto [tally, lacking] = outcome_of(arguments.operands[0], conditions, sample, take);
  if (count > 0) write(certificates::list_end(count));
  if (output) storage::write_atomically(*output, text);
  std::cerr << tally.text();
  if (!lacking.empty() && !tally.all_reproduced())
    std::cerr << "; the file was computed with " << storage::excerpt(lacking) << ", which this machine lacks";
  std::cerr << '\n';
  return tally.all_reproduced() ? done : points_failed;
} catch (const ChoiceError& error) {
  throw UsageError(error.what());
}

constexpr std::string_view certify_examples =
    "  clatter certify fig23.h5 -o fig23.jsonl\n"
    "  clatter certify curve.branch.h5 -o branch.jsonl\n"
    "  clatter certify map.h5 --sample 100 --where nu=1.0 | clatter-verify -\n";

}  // namespace

Command certify_command() {
  return {
      .name = "certify",
      .usage = "certify FILE.h5 [OPTION]...",
      .summary = "write the results of an output as certificates, for clatter-verify to prove",
      .examples = certify_examples,
      .operands = {"FILE.h5"},
      .required_operands = 1,
      .options = {{"sample", 0, "N", "certify only N points, and as many special points, spread evenly; default: all"},
                  where_option,
                  {"output", 'o', "FILE.jsonl", "output file; default: standard output"},
                  force_option,
                  {"help", 'h', "", "print this help"}},
      .run = certify};
}

}  // namespace clatter::app
