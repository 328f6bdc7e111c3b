#pragma once

#include <string>

#include "config/config.hpp"
#include "results/dataset_file.hpp"

namespace clatter::outputs {

/// Reads the summary of an output as `results::read_summary` does. Throws IoError also if it hasn't the points of the
/// configuration that it holds; one of another version, which can't be read, isn't asked.
[[nodiscard]] results::FileSummary read_summary(const std::string& path);

/// The configuration that an output was made of. Throws IoError if it has none that runs.
[[nodiscard]] config::Config config_of_output(const results::FileSummary& summary, const std::string& path);

}  // namespace clatter::outputs
