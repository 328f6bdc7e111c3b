#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "results/dataset_file.hpp"

namespace clatter::results {

/// A summary as bytes, to pass from one process to another.
[[nodiscard]] std::string bytes_of(const FileSummary& summary);

/// The summary from its bytes; nothing if they are no summary, as a process with corrupted memory may send them.
[[nodiscard]] std::optional<FileSummary> summary_from(std::string_view bytes);

}  // namespace clatter::results
