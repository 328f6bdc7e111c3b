#pragma once

#include <string>

namespace clatter {

/// A text and the words before each of its lines.
struct NamedText {
  std::string name;
  const std::string& text;
};

/// Lines that only one of two configurations has, the first few of them, each after a line break, as `excerpt` shows
/// it.
[[nodiscard]] std::string difference(const NamedText& one, const NamedText& other);

}  // namespace clatter
