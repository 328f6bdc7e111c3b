#include "config_arguments.hpp"

#include <malloc.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>

#include "config/suggestion.hpp"
#include "progress.hpp"

namespace clatter {

Config config_of(const Arguments& arguments) {
  std::vector<Override> overrides;
  for (const std::string& word : arguments.values("set")) {
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos || word.find_first_not_of(" \t") == sign) {
      throw UsageError("--set " + in_quotes(word) + " is no KEY=VALUE; write e.g. --set scene.R=0.5");
    }
    overrides.push_back({word.substr(0, sign), word.substr(sign + 1)});
  }
  Config config = read_config(arguments.operands[0], overrides, arguments.has("ini") ? Format::ini : Format::toml);
  malloc_trim(0);  // a long list takes many times its length while it is read
  return config;
}

int threads_of(const Arguments& arguments) {
  const std::optional<std::string> word = arguments.value("threads");
  if (!word) return 0;
  int threads = 0;
  const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), threads);
  if (error != std::errc{} || end != word->data() + word->size() || threads < 1 || threads > 1024) {
    throw UsageError("--threads " + in_quotes(*word) + "; permitted: a whole number from 1 to 1024");
  }
  return threads;
}

std::optional<Shard> shard_of(const Arguments& arguments) {
  const std::optional<std::string> word = arguments.value("shard");
  if (!word) return std::nullopt;
  const std::optional<Shard> shard = shard_named(*word);
  if (!shard)
    throw UsageError("--shard " + in_quotes(*word) +
                     "; permitted: K/N, two whole numbers, K from 0 to N - 1, N up to " + std::to_string(Shard::most));
  return shard;
}

Arch arch_of(const Arguments& arguments) {
  const char* const variable = std::getenv("CLATTER_ARCH");
  const std::optional<std::string> option = arguments.value("arch");
  if (!option && (variable == nullptr || *variable == '\0')) return best_arch();
  const std::string name = option ? *option : variable;
  const std::string given = std::string(option ? "--arch " : "CLATTER_ARCH=").append(in_quotes(name));
  const std::optional<Arch> arch = arch_named(name);
  if (!arch) throw UsageError(given + "; permitted: scalar, sse2, avx2, avx512");
  if (!runs_here(*arch))
    throw UsageError(given + ": this machine doesn't have it; its widest is " + std::string(name_of(best_arch())));
  return *arch;
}

bool progress_wanted(const Arguments& arguments) {
  const std::string when = arguments.value("progress").value_or("auto");
  if (when == "always" || when == "never") return when == "always";
  if (when == "auto") return stderr_is_terminal() && !arguments.has("quiet");
  throw UsageError("--progress " + in_quotes(when) + "; permitted: auto, always, never");
}

std::string output_of(const Arguments& arguments, const std::string& ending) {
  const std::filesystem::path config(arguments.operands[0]);
  if (config == standard_input && !arguments.has("output"))
    throw UsageError("a configuration from stdin gives the output no name; name it with -o FILE.h5");
  return arguments.value("output").value_or(config.stem().string() + ending);
}

void check_not_config(const std::string& config, const std::string& output) {
  std::error_code error;
  if (!std::filesystem::equivalent(config, output, error)) return;
  throw UsageError("the output " + in_quotes(output) + " is the configuration itself; name another file with -o");
}

}  // namespace clatter
