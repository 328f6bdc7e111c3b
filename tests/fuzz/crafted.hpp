#pragma once

#include <string>
#include <utility>
#include <vector>

namespace clatter::fuzz {

/// Files that were made to harm their reader, out of a sound one whose bytes are given: each has its `x` elsewhere, or
/// something in its place that no output has. Names and bytes.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> crafted_files(const std::string& sound);

}  // namespace clatter::fuzz
