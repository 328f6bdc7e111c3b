#include <chrono>
#include <iostream>
#include <optional>
#include <vector>

#include "accuracy/accuracy_dataset.hpp"
#include "commands/commands.hpp"
#include "results/dataset_file.hpp"
#include "results/output_place.hpp"
#include "runs/accuracy_report.hpp"
#include "storage/journal.hpp"
#include "storage/utf8.hpp"
#include "tables/json_output.hpp"
#include "terminal/common_options.hpp"
#include "terminal/signals.hpp"
#include "terminal/warnings.hpp"

namespace clatter::app {
namespace {

void check_scenes(const config::Config& config, const std::string& file) {
  if (move_by_themselves(config.sweep))
    throw UsageError(
        storage::printable(file) +
        ": stops that move by themselves are computed by the exact method alone, so there is none to compare "
        "it with; let both move alike by stop_amplitude");
  if (!config.sweep.follow) return;
  throw UsageError(storage::printable(file) +
                   ": [sweep] follow: an accuracy run starts every point from [scene]; add --set sweep.follow=''");
}

/// Sections that an accuracy run ignores: it chooses observables and integrators itself.
constexpr std::string_view not_read[] = {"observe", "integrator"};

using PointText = std::string (*)(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep,
                                  std::size_t point);

PointText text_of(const Arguments& arguments) {
  if (arguments.has("json") && arguments.has("verbose"))
    throw UsageError("--json conflicts with --verbose, since it has every row; give one of them");
  return arguments.has("json") ? accuracy_json : arguments.has("verbose") ? accuracy_text : accuracy_answer;
}

/// Measures and prints all points, or fewer if it is interrupted.
std::vector<accuracy::PointAccuracy> measure_points(const sweep::Sweep& sweep, lanes::InstructionSet arch,
                                                    PointText text_of, ProgressKind shown,
                                                    const std::optional<int>& rounds) {
  const std::vector<accuracy::Trial> trials = accuracy::trials_of(sweep.problem.time.mode, arch);
  Progress progress(shown, "runs");
  accuracy::AccuracyOptions options{.stopped = [] { return Interrupt::signal() != 0; }};
  if (rounds) options.rounds = *rounds;
  std::vector<accuracy::PointAccuracy> points;
  std::size_t finished = 0;
  const auto total = static_cast<double>(size(sweep) * steps_of(trials.size(), options));
  progress.show(0, total, std::nullopt);
  const auto begin = std::chrono::steady_clock::now();
  // Points not yet begun are assumed to take as long as the others.
  options.progress = [&](std::optional<double> seconds_left) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    const auto begun = static_cast<double>(points.size() + 1), all = static_cast<double>(size(sweep));
    if (seconds_left) *seconds_left += (passed.count() + *seconds_left) / begun * (all - begun);
    progress.show(static_cast<double>(++finished), total, seconds_left);
  };
  for (std::size_t point = 0; point < size(sweep); ++point) {
    accuracy::PointAccuracy of_point = measure_accuracy(problem_at(sweep, point), trials, options);
    if (Interrupt::signal() != 0) break;
    std::cout << text_of(of_point, sweep, point) << std::flush;
    points.push_back(std::move(of_point));
  }
  return points;
}

bool any_failed(const std::vector<accuracy::PointAccuracy>& points) {
  for (const accuracy::PointAccuracy& point : points)
    for (const accuracy::WorkPrecision& row : point.rows)
      if (row.trial.method == accuracy::TestedMethod::exact && failed(row.status)) return true;
  return false;
}

int run_accuracy(const Arguments& arguments) {
  const lanes::InstructionSet arch = arch_of(arguments);
  const PointText text_of_point = text_of(arguments);
  const ProgressKind shown = progress_kind(arguments);
  const std::optional<int> rounds = count_of(arguments, "rounds", 1000);
  const std::string output = output_of(arguments, ".accuracy.h5");
  const config::Config config = config_of(arguments);
  check_scenes(config, arguments.operands[0]);
  const results::OutputPlace place(output, {.command = "accuracy", .title = config.title}, arguments.has("force"));
  storage::require_idle(output);
  if (!arguments.has("quiet")) warn(config, not_read);
  const Interrupt interrupt;
  const std::vector<accuracy::PointAccuracy> points = measure_points(config.sweep, arch, text_of_point, shown, rounds);
  if (const int signal = Interrupt::signal()) {
    std::cerr << "stopped after " << points.size() << " of " << size(config.sweep) << " points; "
              << storage::printable(output) << " is not written\n";
    return 128 + signal;
  }
  place.write_atomically(
      [&](storage::FileWriter& file) { results::write_file(file, accuracy_dataset(config.sweep, points), config); });
  if (!arguments.has("quiet")) std::cerr << storage::printable(output) << '\n';
  return any_failed(points) ? points_failed : done;
}

constexpr std::string_view accuracy_examples =
    "  clatter accuracy configs/accuracy_smooth.toml\n"
    "  clatter accuracy mine.toml --json --set scene.R=0.5 > mine.jsonl\n";

}  // namespace

Command accuracy_command() {
  return {.name = "accuracy",
          .usage = "accuracy CONFIG [OPTION]...",
          .summary = "measure what accuracy costs in time: methods and settings against a 50-digit reference",
          .examples = accuracy_examples,
          .operands = {"CONFIG"},
          .required_operands = 1,
          .options = {{"output", 'o', "FILE.h5", "output file; default: NAME.accuracy.h5 in this directory"},
                      force_option,
                      set_option,
                      ini_option,
                      arch_option,
                      {"verbose", 'v', "", "print every row as well: all settings, errors and counts"},
                      {"json", 0, "", "print a JSON object per row instead"},
                      {"rounds", 0, "N", "measure each time N times, 1 to 1000; default: 9"},
                      progress_option,
                      {"quiet", 'q', "", "print no progress, only answers and errors"},
                      {"help", 'h', "", "print this help"}},
          .run = run_accuracy};
}

}  // namespace clatter::app
