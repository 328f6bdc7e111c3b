#include "config_arguments.hpp"

#include <charconv>

#include "io/suggestion.hpp"

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
  return read_config(arguments.operands[0], overrides);
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

}  // namespace clatter
