#pragma once

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace clatter::support {

/// The numbers from ... to - 1 of the random scenes that a test draws.
struct SceneRange {
  std::uint64_t from, to;
};

/// `count` scenes from the first on, or those that the environment variable CLATTER_SCENES names as FROM:TO.
inline SceneRange scene_range(std::uint64_t count) {
  const char* const text = std::getenv("CLATTER_SCENES");
  if (text == nullptr) return {0, count};
  const std::string range(text);
  const std::size_t colon = range.find(':');
  if (colon == std::string::npos) throw std::invalid_argument("CLATTER_SCENES is FROM:TO, not " + range);
  return {std::stoull(range.substr(0, colon)), std::stoull(range.substr(colon + 1))};
}

}  // namespace clatter::support
