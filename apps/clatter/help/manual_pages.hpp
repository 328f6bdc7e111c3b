#pragma once

#include <string>
#include <vector>

namespace clatter::app {

/// A man page.
struct ManualPage {
  std::string path;  ///< below PREFIX/share: "man/man1/clatter.1"
  std::string text;
};

/// clatter(1), a page for each command, and clatter-config(5), made from the same tables as the help.
[[nodiscard]] std::vector<ManualPage> manual_pages();

}  // namespace clatter::app
