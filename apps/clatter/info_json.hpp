#pragma once

#include <string>

#include "results/dataset_file.hpp"

namespace clatter::app {

/// A file's summary as JSON: attributes, dimensions, variables, number of points by status.
[[nodiscard]] std::string json(const results::FileSummary& summary);

}  // namespace clatter::app
