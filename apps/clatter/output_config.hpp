#pragma once

#include <string>
#include <vector>

#include "config/config.hpp"
#include "results/dataset_file.hpp"
#include "sweep/dataset.hpp"

namespace clatter::app {

/// The configuration that an output was made of. Throws IoError if it has none that runs.
[[nodiscard]] config::Config config_of_output(const results::FileSummary& summary, const std::string& path);

/// The values of a variable; null if the results have none of this type and name.
template <class T>
[[nodiscard]] const std::vector<T>* values_of(const sweep::Dataset& results, std::string_view name) {
  for (const sweep::Variable& variable : results.variables)
    if (variable.name == name) return std::get_if<std::vector<T>>(&variable.values);
  return nullptr;
}

}  // namespace clatter::app
