#pragma once

#include <vector>

#include "manual_file.hpp"

namespace clatter::app {

/// clatter(1), a page for each command, and clatter-config(5), made from the same tables as the help.
[[nodiscard]] std::vector<ManualFile> manual_pages();

}  // namespace clatter::app
