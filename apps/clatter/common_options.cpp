#include "common_options.hpp"

#include <malloc.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>

#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {

std::vector<config::Override> overrides_of(const Arguments& arguments) {
  std::vector<config::Override> overrides;
  for (const std::string& word : arguments.values("set")) {
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos || word.find_first_not_of(" \t") == sign) {
      throw UsageError("--set " + config::in_quotes(word) + " is not KEY=VALUE; write e.g. --set scene.R=0.5");
    }
    overrides.push_back({word.substr(0, sign), word.substr(sign + 1)});
  }
  return overrides;
}

config::Config config_of(const Arguments& arguments, const std::vector<config::Override>& changes) {
  std::vector<config::Override> overrides = overrides_of(arguments);
  overrides.insert(overrides.end(), changes.begin(), changes.end());
  config::Config config =
      read_config(arguments.operands[0], overrides, arguments.has("ini") ? config::Format::ini : config::Format::toml);
  malloc_trim(0);  // reading a long list takes many times its length
  return config;
}

int threads_of(const Arguments& arguments) {
  const std::optional<std::string> word = arguments.value("threads");
  if (!word) return 0;
  int threads = 0;
  const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), threads);
  if (error != std::errc{} || end != word->data() + word->size() || threads < 1 || threads > 1024) {
    throw UsageError("--threads " + config::in_quotes(*word) + "; expected a whole number from 1 to 1024");
  }
  return threads;
}

std::optional<results::Shard> shard_of(const Arguments& arguments) {
  const std::optional<std::string> word = arguments.value("shard");
  if (!word) return std::nullopt;
  const std::optional<results::Shard> shard = results::shard_named(*word);
  if (!shard)
    throw UsageError("--shard " + config::in_quotes(*word) +
                     "; expected K/N, two whole numbers, K from 0 to N - 1, N up to " +
                     std::to_string(results::Shard::most));
  return shard;
}

lanes::InstructionSet arch_of(const Arguments& arguments) {
  const char* const variable = std::getenv("CLATTER_ARCH");
  const std::optional<std::string> option = arguments.value("arch");
  if (!option && (variable == nullptr || *variable == '\0')) return lanes::widest_instruction_set();
  const std::string name = option ? *option : variable;
  const std::string given = std::string(option ? "--arch " : "CLATTER_ARCH=").append(config::in_quotes(name));
  const std::optional<lanes::InstructionSet> arch = lanes::instruction_set_named(name);
  if (!arch) throw UsageError(given + "; expected one of " + config::joined(lanes::instruction_set_names));
  if (!is_supported(*arch))
    throw UsageError(given + ": this machine doesn't have it; its widest is " +
                     std::string(lanes::name_of(lanes::widest_instruction_set())));
  return *arch;
}

ProgressKind progress_kind(const Arguments& arguments) {
  const std::string when = arguments.value("progress").value_or("auto");
  if (when == "always" || when == "never") return when == "always" ? ProgressKind::bar : ProgressKind::none;
  if (when == "auto" && arguments.has("quiet")) return ProgressKind::none;
  if (when == "auto") return stderr_is_terminal() ? ProgressKind::bar : ProgressKind::lines;
  throw UsageError("--progress " + config::in_quotes(when) + "; expected one of " + config::joined(progress_choices));
}

std::string output_of(const Arguments& arguments, const std::string& ending) {
  const std::filesystem::path config(arguments.operands.empty() ? arguments.value("from").value_or("")
                                                                : arguments.operands[0]);
  if (config == config::standard_input && !arguments.has("output"))
    throw UsageError("a configuration from stdin has no name to give the output; name it with -o FILE.h5");
  const std::string output = arguments.value("output").value_or(config.stem().string() + ending);
  check_name_of_results(output);
  return output;
}

void check_name_of_results(const std::string& output) {
  constexpr std::string_view others[] = {".csv", ".tsv",  ".txt", ".dat", ".json", ".jsonl", ".mat",
                                         ".npz", ".xlsx", ".ods", ".svg", ".png",  ".html",  ".pdf"};
  const std::filesystem::path path(output);
  const bool is_other =
      std::ranges::any_of(others, [&](std::string_view ending) { return config::has_ending(output, ending); });
  if (!is_other) return;
  const std::string own = std::filesystem::path(path).replace_extension(".h5").string();
  throw UsageError("-o " + storage::quoted_name(output) + ": results are HDF5; write -o " + storage::printable(own) +
                   ", and then e.g. clatter export " + storage::printable(own) + " -o FILE.csv");
}

void check_not_config(const std::string& config, const std::string& output) {
  check_not_input(config, output, "the configuration itself");
}

void check_not_input(const std::string& input, const std::string& output, const std::string& what) {
  std::error_code error;
  if (!std::filesystem::equivalent(input, output, error)) return;
  throw UsageError("the output " + config::in_quotes(output) + " is " + what + "; name another file with -o");
}

}  // namespace clatter::app
