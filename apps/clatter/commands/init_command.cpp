#include <algorithm>
#include <filesystem>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "config/config.hpp"
#include "config/suggestion.hpp"
#include "config/wrapped.hpp"
#include "help/models.hpp"
#include "storage/atomic_write.hpp"
#include "storage/error.hpp"
#include "storage/utf8.hpp"
#include "terminal/common_options.hpp"

namespace clatter::app {
namespace {

namespace fs = std::filesystem;

/// The models with the machines that they are of, and the names of the other configurations.
std::string list_of_models() {
  std::size_t column = 0;
  for (const Model& model : models())
    if (!model.machine.empty()) column = std::max(column, model.name.size() + 4);
  std::string text = "My machine has\n", others;
  for (const Model& model : models()) {
    if (model.machine.empty()) {
      (others += others.empty() ? "" : ", ") += model.name;
      continue;
    }
    std::string line = "  " + std::string(model.name);
    line.resize(column, ' ');
    text += line + config::wrapped(model.machine, column);
  }
  return text + "\nOther configurations, of the paper and of each kind of sweep\n  " + config::wrapped(others, 2) +
         "\nclatter init MODEL writes MODEL.toml, to be changed and run.\n";
}

const Model& model_named(std::string_view name) {
  std::vector<std::string_view> names, of_guide;
  for (const Model& model : models()) {
    if (model.name == name) return model;
    names.push_back(model.name);
    if (!model.machine.empty()) of_guide.push_back(model.name);
  }
  const std::string_view stem = name.substr(0, name.size() - (name.ends_with(".toml") ? 5 : 0)),
                         near = config::nearest(stem, names);
  throw UsageError("unknown model " + config::in_quotes(name) +
                   (near.empty() ? "; expected one of " + config::joined(of_guide) + "; see `clatter init`"
                                 : "; did you mean '" + std::string(near) + "'?"));
}

/// The command that a configuration is made for: its text names `clatter accuracy`, or it says what to follow and
/// sweeps nothing.
std::string_view command_of(const Model& model) {
  if (model.text.find("clatter accuracy") != std::string_view::npos) return "accuracy";
  const config::Config config = config::parse_config(std::string(model.text), std::string(model.name));
  return config.branch && config.sweep.dimensions.empty() ? "branch" : "run";
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() != fs::file_type::not_found;
}

/// A name like this one that no file has: drill2.toml.
std::string free_name(const fs::path& path) {
  for (int i = 2;; ++i) {
    fs::path other = path.parent_path() / path.stem();
    other += std::to_string(i), other += path.extension();
    if (!is_there(other)) return other.string();
  }
}

/// Throws IoError if a file has that name, as a configuration that somebody has worked on is never replaced.
void refuse_existing(const std::string& path) {
  if (is_there(path))
    throw storage::IoError("cannot write " + storage::quoted_name(path) +
                           ": there is a file, which is kept; take another name: -o " + free_name(path));
}

int write_model(const Arguments& arguments) {
  if (arguments.operands.empty()) {
    if (arguments.has("output")) throw UsageError("-o without a model; write e.g. clatter init drill -o mine.toml");
    std::cout << list_of_models();
    return done;
  }
  const Model& model = model_named(arguments.operands[0]);
  const std::string path = arguments.value("output").value_or(std::string(model.name) + ".toml");
  if (path == "-") {
    std::cout << model.text;
    return done;
  }
  check_name(path, FileKind::configuration);
  storage::check_writable(path);
  const auto refuse = [&] { refuse_existing(path); };
  refuse();
  storage::write_atomically(path, model.text, {.before_rename = refuse});
  const std::string command = "clatter " + std::string(command_of(model)) + ' ' + path;
  std::cerr << storage::printable(path + ": written; change it, and run it by: " + command) << '\n';
  return done;
}

constexpr std::string_view init_examples =
    "  clatter init\n"
    "  clatter init drill\n"
    "  clatter init soft_bumper -o mine.toml\n";

}  // namespace

Command init_command() {
  return {.name = "init",
          .usage = "init [MODEL] [-o FILE.toml]",
          .summary = "write the configuration of a model to begin with, or list the models",
          .examples = init_examples,
          .operands = {"MODEL"},
          .required_operands = 0,
          .options = {{"output", 'o', "FILE.toml",
                       "file to write, never over an existing one; default: MODEL.toml; -: standard output"},
                      {"help", 'h', "", "print this help"}},
          .run = write_model};
}

}  // namespace clatter::app
