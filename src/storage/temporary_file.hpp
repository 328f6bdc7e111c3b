#pragma once

#include <sys/types.h>

#include <filesystem>

#include "storage/file_calls.hpp"

namespace clatter::storage {

/// Removes files that a killed process has left under a temporary name of this target; any other file stays.
void remove_abandoned(const std::filesystem::path& target);

/// A file without a name in a directory, for reading and writing; its number is negative if that fails (errno).
[[nodiscard]] Descriptor nameless_file(const std::filesystem::path& directory, mode_t mode);

/// A new file that goes away again, with its process at the latest, unless it becomes its target. It has no name, if
/// its file system has such files, until it takes that of the target by way of `.TARGET.clatter-XXXXXXXX.tmp`; else it
/// has that name from the beginning, and is locked, so that no other run takes it for abandoned. Throws an IoError that
/// names the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path target);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  /// The file, open for reading and writing.
  [[nodiscard]] const Descriptor& descriptor() const { return file_; }
  /// Waits until the bytes are on the disk.
  void sync();
  void become_target();

 private:
  [[nodiscard]] Descriptor create();
  [[nodiscard]] Descriptor create_nameless(mode_t mode) const;
  [[nodiscard]] Descriptor create_named(mode_t mode);
  void give_name();

  std::filesystem::path target_;
  std::filesystem::path path_{};  ///< empty: the file has no name of its own
  Descriptor file_;
};

}  // namespace clatter::storage
