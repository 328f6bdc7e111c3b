#pragma once

#include <string>
#include <utility>
#include <vector>

namespace clatter::fuzz {

/// Names and bytes of files made to harm their reader, from the bytes of a sound one: each has its `x` elsewhere, or
/// an object in its place that no output has.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> crafted_files(const std::string& sound);

}  // namespace clatter::fuzz
