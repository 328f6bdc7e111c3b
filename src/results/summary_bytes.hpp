#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "results/dataset_file.hpp"

namespace clatter::results {

/// A summary as bytes, to pass from one process to another.
[[nodiscard]] std::string bytes_of(const FileSummary& summary);

/// The summary again; nothing where the bytes are none, as a process may send them whose memory was disturbed.
[[nodiscard]] std::optional<FileSummary> summary_from(std::string_view bytes);

}  // namespace clatter::results
