#pragma once

#include <string>

namespace clatter::app {

/// A man page or a completion.
struct ManualFile {
  std::string path;  ///< below PREFIX/share: "man/man1/clatter.1"
  std::string text;
};

}  // namespace clatter::app
