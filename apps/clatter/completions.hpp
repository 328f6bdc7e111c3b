#pragma once

#include <vector>

#include "manual_file.hpp"

namespace clatter::app {

/// Completions for bash, zsh and fish, made from the same tables as the help: commands, options with their words, files
/// by their endings, keys after --set with what they permit.
[[nodiscard]] std::vector<ManualFile> completions();

}  // namespace clatter::app
