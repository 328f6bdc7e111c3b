#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <string>

#include "storage/file_calls.hpp"

namespace clatter::storage {

/// A file to be read, and the space that it takes on its disk: for a sparse file less than its length.
struct InputFile {
  Descriptor file;
  std::uint64_t stored_bytes = 0;
};

/// Throws the IoError of a file that cannot be read.
[[noreturn]] void refuse_reading(const std::string& path, const std::string& why, const std::string& way_out);

/// The space that a file takes on its disk; its length if the file system doesn't tell.
[[nodiscard]] std::uint64_t stored_bytes(const struct stat& status);

/// Opens a file for reading; never blocks, as opening a pipe would. Throws IoError unless it is a regular file that can
/// be read; `wanted` is the kind of file to name instead, e.g. "an output of clatter".
[[nodiscard]] InputFile open_input(const std::string& path, const std::string& wanted);

}  // namespace clatter::storage
