#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace clatter {

/// Throws IoError where `path` cannot become an output file: no such directory, a directory or a device itself, no
/// permission, an older file that is write-protected. Changes nothing.
void check_writable(const std::string& path);

/// Makes `bytes` appear at `path` completely or not at all: temporary file beside it, fsync, rename, fsync of the
/// directory. A symbolic link is followed, as by a redirection of the shell: it stays, and the file that it names is
/// replaced. Throws IoError and removes the temporary file where that fails; an older file is then untouched.
/// `before_rename` may throw, too: it is the last to see an older file.
void publish(
    const std::string& path, std::span<const std::byte> bytes, const std::function<void()>& before_rename = [] {});

}  // namespace clatter
