#pragma once

#include <string>

namespace verify {

/// A text of a file as a terminal may show it: what a terminal obeys, what turns or hides the text around it, and bytes
/// that are no UTF-8 are written as their numbers.
[[nodiscard]] std::string printable(const std::string& text);

}  // namespace verify
