#pragma once

#include <string>

#include "results/figure_file.hpp"

namespace clatter {

/// A file's summary as JSON: attributes, dimensions, variables, number of points by status.
[[nodiscard]] std::string json(const FileSummary& summary);

}  // namespace clatter
