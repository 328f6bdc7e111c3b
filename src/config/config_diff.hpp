#pragma once

#include <string>

namespace clatter::config {

/// A text and the words before each of its lines.
struct NamedText {
  std::string name;
  const std::string& text;
};

/// The first few lines that only one of two configurations has, each after a line break and shown as by `excerpt`.
[[nodiscard]] std::string config_diff(const NamedText& one, const NamedText& other);

}  // namespace clatter::config
