#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace clatter {

/// Throws IoError where `path` cannot become an output file: no such directory, a directory itself, no permission. Changes nothing.
void check_writable(const std::string& path);

/// Makes `bytes` appear at `path` completely or not at all: temporary file beside it, fsync, rename, fsync of the directory.
/// Throws IoError and removes the temporary file where that fails; an older file at `path` is then untouched.
void publish(const std::string& path, std::span<const std::byte> bytes);

}  // namespace clatter
