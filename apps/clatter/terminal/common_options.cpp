#include "terminal/common_options.hpp"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {
namespace {

/// Endings of names that say of what kind a file is.
constexpr std::array<std::string_view, 24> endings{".h5",   ".hdf5",  ".hdf", ".nc",   ".csv", ".tsv",  ".txt", ".dat",
                                                   ".json", ".jsonl", ".mat", ".npz",  ".xls", ".xlsx", ".ods", ".svg",
                                                   ".png",  ".html",  ".pdf", ".toml", ".ini", ".py",   ".md",  ".zip"};
constexpr std::array<std::string_view, 10> like_tables{".tsv", ".txt", ".dat", ".json", ".jsonl",
                                                       ".mat", ".npz", ".xls", ".xlsx", ".ods"};

/// A kind of file that is written: what it is, and the endings that it may have, the usual one first.
struct Written {
  std::string_view words;
  std::vector<std::string_view> endings;
};
const std::array<Written, 4> written_kinds{{{"results are HDF5", {".h5", ".hdf5", ".hdf", ".nc"}},
                                            {"a table is CSV, which spreadsheets open, too", {".csv", ".txt", ".dat"}},
                                            {"certificates are JSON, one a line", {".jsonl", ".json", ".txt"}},
                                            {"a configuration is TOML", {".toml", ".txt"}}}};

}  // namespace

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

std::optional<int> count_of(const Arguments& arguments, std::string_view option, std::optional<int> most) {
  const std::optional<std::string> word = arguments.value(option);
  if (!word) return std::nullopt;
  int count = 0;
  const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), count);
  if (error != std::errc{} || end != word->data() + word->size() || count < 1 || (most && count > *most))
    throw UsageError("--" + std::string(option) + ' ' + config::in_quotes(*word) + "; expected a whole number from 1 " +
                     (most ? "to " + std::to_string(*most) : "on"));
  return count;
}

int threads_of(const Arguments& arguments) { return count_of(arguments, "threads", 1024).value_or(0); }

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
  if (!arguments.operands.empty()) check_not_config(arguments.operands[0], output);
  check_name(output, FileKind::results);
  return output;
}

void check_name(const std::string& output, FileKind kind) {
  const Written& written = written_kinds[static_cast<std::size_t>(kind)];
  const auto has = [&](std::string_view ending) { return config::has_ending(output, ending); };
  if (std::ranges::none_of(endings, has) || std::ranges::any_of(written.endings, has)) return;
  std::filesystem::path path(output);
  const std::string own = storage::printable(path.replace_extension(written.endings.front()).string());
  const bool is_table = has(".csv") || std::ranges::any_of(like_tables, has);
  throw UsageError(
      "-o " + storage::quoted_name(output) + ": " + std::string(written.words) + "; write -o " + own +
      (kind == FileKind::results && is_table ? ", and then e.g. clatter export " + own + " -o FILE.csv" : ""));
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
