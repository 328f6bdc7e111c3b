#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <string>

#include "storage/file_calls.hpp"

namespace clatter::storage {

/// A file to be read, and the room that it takes on its disk: of a sparse file less than its length.
struct InputFile {
  Descriptor file;
  std::uint64_t stored_bytes = 0;
};

/// The room that a file takes on its disk; its length, where the file system doesn't tell.
[[nodiscard]] std::uint64_t stored_bytes(const struct stat& status);

/// Opens a file for reading, without waiting for anyone. Throws IoError unless it is a regular file that can be read;
/// `wanted` says which file is meant to be named, e.g. "an output of clatter".
[[nodiscard]] InputFile open_input(const std::string& path, const std::string& wanted);

}  // namespace clatter::storage
