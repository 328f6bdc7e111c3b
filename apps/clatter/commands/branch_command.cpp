#include <algorithm>
#include <iostream>

#include "branches/branch_dataset.hpp"
#include "branches/curve.hpp"
#include "branches/measures/measures.hpp"
#include "commands/commands.hpp"
#include "results/dataset_file.hpp"
#include "results/output_place.hpp"
#include "runs/branch_start.hpp"
#include "storage/journal.hpp"
#include "storage/utf8.hpp"
#include "tables/json_output.hpp"
#include "terminal/common_options.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

using branches::SpecialPoint;

/// "fold                  nu = 1.42486182628998  speed 1.72122564705845  LU  branch 0"
std::string special_text(const SpecialPoint& special, const std::vector<Parameter>& parameters, const Units& units,
                         const branches::WordLetters& letters) {
  std::string text(name_of(special.kind));
  const std::string word = special.at.orbit.word(letters);
  text.resize(22, ' ');
  for (const Parameter parameter : parameters)
    text += std::string(parameter.key()) + " = " + formatted("%-18.15g", value_of(special.at.scene, parameter)) + ' ';
  const double speed = factor_of(units, Quantity::velocity) * branches::impact_speed(special.at.orbit, letters);
  text += "speed " + formatted("%-18.15g", speed) + ' ' +
          (word == observables::ImpactWord::no_contact ? "no impacts" : word) +
          (parameters.size() > 1 ? "  curve" : "  branch");
  if (special.branches.size() > 1) text += parameters.size() > 1 ? "s" : "es";
  for (const std::size_t branch : special.branches) text += ' ' + std::to_string(branch);
  return text + '\n';
}

/// "nu = 0.91"
std::string place_of(const branches::FollowedScene& scene, const Parameter parameter) {
  return std::string(parameter.key()) + " = " + formatted("%.9g", value_of(scene, parameter));
}

/// "mine.toml: branch 2 stops at nu = 0.91: branch.max_points is spent"
void tell_failures(const branches::Branches& found, const branches::BranchSettings& settings, const std::string& file) {
  for (const branches::BranchEnd& end : found.ends)
    if (end.failed) {
      std::cerr << storage::printable(file) << (end.of_curve ? ": curve " : ": branch ") << end.branch << " stops at "
                << place_of(end.scene, settings.along);
      if (end.of_curve) std::cerr << ", " << place_of(end.scene, *settings.across);
      std::cerr << ": " << end.reason << '\n';
    }
}

ExitCode code_of(const branches::Branches& found) {
  return std::ranges::any_of(found.ends, &branches::BranchEnd::failed) ? points_failed : done;
}

/// "births that aren't followed: 0 symmetry, 2 flip, 1 graze (branch.births, branch.switch)"
void tell_left_out(const branches::Branches& found) {
  if (std::ranges::all_of(found.left_out, [](std::size_t count) { return count == 0; })) return;
  std::cerr << "births that aren't followed: " << branches::births_text(found.left_out)
            << " (branch.births, branch.switch)\n";
}

int run_branch(const Arguments& arguments) {
  const std::string output = output_of(arguments, ".branch.h5");
  const auto [config, file, note] = branch_start_of(arguments);
  if (const auto from = arguments.value("from")) check_not_input(*from, output, "the one of --from");
  const branches::BranchSettings& settings = *config.branch;
  const results::OutputPlace place(output, {.command = "branch", .title = config.title}, arguments.has("force"));
  storage::require_idle(output);
  if (!note.empty() && !arguments.has("quiet")) std::cerr << note << '\n';
  const branches::StartProblem start(config.sweep.problem);
  branches::Branches found;
  try {
    found = settings.across ? branches::follow_curves(start, settings) : branches::follow_branches(start, settings);
  } catch (const branches::SettingError& error) {
    throw UsageError(storage::printable(file) + ": " + error.what());
  } catch (const branches::StartError& error) {
    std::cerr << storage::printable(file) << ": " << error.what() << '\n';
    return points_failed;
  }
  std::vector<Parameter> parameters{settings.along};
  if (settings.across) parameters.push_back(*settings.across);
  // before anything is printed, as a reader such as head may close the pipe
  const results::FileHead& head = config;
  const auto write = [&](storage::FileWriter& to) {
    results::write_file(to, branch_dataset(found, settings, start.units, has_loose_mass(start.loose)), head);
  };
  place.write_atomically(write);
  for (const SpecialPoint& special : found.special)
    std::cout << (arguments.has("json") ? special_json : special_text)(special, parameters, start.units, found.letters);
  std::cout << std::flush;
  tell_failures(found, settings, file);
  if (arguments.has("quiet")) return code_of(found);
  tell_left_out(found);
  std::cerr << counted(static_cast<double>(found.points.size()), "point") << ", "
            << counted(static_cast<double>(found.special.size()), "special point") << ", " << storage::printable(output)
            << '\n';
  return code_of(found);
}

constexpr std::string_view branch_examples =
    "  clatter branch configs/branch.toml\n"
    "  clatter branch mine.toml --json --set branch.range='0.8, 1.5' | jq .nu\n"
    "  clatter branch mine.toml --from map.h5 --where nu=1.2 --where R=0.7\n"
    "  clatter branch --from mine.branch.h5 --where branch=2 --where nu=1.2 -o b.h5\n";

}  // namespace

Command branch_command() {
  return {
      .name = "branch",
      .usage = "branch [CONFIG] [--from FILE.h5] [OPTION]...",
      .summary =
          "follow periodic motion, stable and unstable, along a parameter; list its folds, flips, grazes and maxima",
      .examples = branch_examples,
      .operands = {"CONFIG"},
      .required_operands = 0,
      .options =
          {{"output", 'o', "FILE.h5", "output file; default: NAME.branch.h5 in this directory"},
           from_option,
           {"where", 0, "NAME=VALUE",
            "the point of --from: at this value of an axis, or on branches of their parameter, or by the numbers "
            "branch and point; repeatable",
            true},
           force_option,
           set_option,
           ini_option,
           {"json", 0, "", "print a JSON object per special point instead"},
           {"quiet", 'q', "", "print only special points and errors"},
           {"help", 'h', "", "print this help"}},
      .run = run_branch};
}

}  // namespace clatter::app
