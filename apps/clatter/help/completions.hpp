#pragma once

#include <string>

namespace clatter::app {

/// Completions, made from the same tables as the help: commands, options with their words, files by their endings, keys
/// after --set with their permitted values.
[[nodiscard]] std::string bash_completion();
[[nodiscard]] std::string zsh_completion();
[[nodiscard]] std::string fish_completion();

}  // namespace clatter::app
