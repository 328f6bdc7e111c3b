#pragma once

#include <string>

namespace clatter::storage {

/// A text and the words before each of its lines.
struct NamedText {
  std::string name;
  const std::string& text;
};

/// Lines that only one of two configurations has, the first few of them, each after a line break, as `excerpt` shows
/// it.
[[nodiscard]] std::string config_diff(const NamedText& one, const NamedText& other);

}  // namespace clatter::storage
