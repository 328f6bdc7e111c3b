#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "storage/file_calls.hpp"

namespace clatter::storage {

/// Removes files that a killed process has left under a temporary name of this target; any other file stays.
void remove_abandoned(const std::filesystem::path& target);

/// A new file beside its target, `.TARGET.clatter-XXXXXXXX.tmp`, that is removed again unless it has become the target.
/// It is locked until then, so that no other run takes it for abandoned. Throws an IoError that names the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path target);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  void write(std::span<const std::byte> bytes);
  /// Waits until the bytes are on the disk.
  void sync();
  void become_target();

 private:
  [[nodiscard]] Descriptor create();

  std::filesystem::path target_, path_;
  Descriptor file_;
};

}  // namespace clatter::storage
