#pragma once

#include <string>

namespace clatter::app {

/// BibTeX of clatter in its version, and of the paper whose figures it reproduces; CITATION.cff says the same.
[[nodiscard]] std::string citation();

}  // namespace clatter::app
