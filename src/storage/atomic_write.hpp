#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace clatter::storage {

/// Throws IoError where `path` cannot become an output file: no such directory, a directory or a device itself, no
/// permission, an older file that is write-protected. Changes nothing.
void check_writable(const std::string& path);

/// Lets go of files that can be spared, in a file system that says it lacks so many bytes.
using MakeRoom = std::function<void(std::uint64_t bytes)>;

/// There are no such files.
inline void no_room(std::uint64_t) {}

/// What happens in the middle of publishing; each may throw, and then nothing is published.
struct PublishSteps {
  MakeRoom make_room = no_room;
  std::function<void()> before_rename = [] {};  ///< is the last to see an older file
};

/// Makes `bytes` appear at `path` completely or not at all: temporary file beside it, fsync, rename, fsync of the
/// directory. A symbolic link is followed, as by a redirection of the shell: it stays, and the file that it names is
/// replaced. The new file has the mode, and where permitted the owner and group, of the one it replaces. Throws IoError
/// and removes the temporary file where that fails; an older file is then untouched.
void write_atomically(const std::string& path, std::span<const std::byte> bytes, const PublishSteps& steps = {});

}  // namespace clatter::storage
