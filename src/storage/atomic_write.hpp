#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "storage/file_writer.hpp"

namespace clatter::storage {

/// Throws IoError if `path` cannot become an output file: no such directory, a directory or a device itself, no
/// permission, an older file that is write-protected. Changes nothing.
void check_writable(const std::string& path);

/// Steps within an atomic write; each may throw, and then the file doesn't appear.
struct WriteSteps {
  MakeRoom make_room = no_room;
  std::function<void()> before_rename = [] {};  ///< called last, while an older file is still there
};

/// Makes a file that `write` writes appear at `path` completely or not at all: temporary file beside it, fsync, rename,
/// fsync of the directory. A symbolic link is followed, as by a redirection of the shell: it stays, and the file that
/// it names is replaced. The new file has the mode, and if permitted the owner and group, of the one it replaces.
/// Throws IoError and removes the temporary file if that fails; an older file is then untouched.
void write_atomically(const std::string& path, const std::function<void(FileWriter&)>& write,
                      const WriteSteps& steps = {});
/// Writes the bytes of a text in this way.
void write_atomically(const std::string& path, std::string_view text, const WriteSteps& steps = {});

}  // namespace clatter::storage
