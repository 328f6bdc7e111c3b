#pragma once

#include <string>

#include "results/dataset_file.hpp"

namespace clatter::app {

/// The summary of a file as JSON: attributes, variables with their dimensions, number of points by status.
[[nodiscard]] std::string json(const results::FileSummary& summary);

}  // namespace clatter::app
