#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "storage/file_calls.hpp"

namespace clatter::storage {

/// Frees disk space, if it can, in a file system that lacks so many bytes.
using MakeRoom = std::function<void(std::uint64_t bytes)>;

/// Frees nothing.
inline void no_room(std::uint64_t) {}

/// Free bytes in the file system of a file or its directory, quotas aside; the largest number if it doesn't tell.
[[nodiscard]] std::uint64_t room_at(const std::filesystem::path& path);

/// Writes a file that is being made, at any place of it. If its disk is full, asks for room and goes on. Throws an
/// IoError that names the file.
class FileWriter {
 public:
  /// `file` is open for reading and writing, and has the name `named` in errors.
  FileWriter(const Descriptor& file, std::filesystem::path named, MakeRoom make_room = no_room);

  void write(std::uint64_t at, std::span<const std::byte> bytes);
  /// Beyond the end of the file, zeros.
  void read(std::uint64_t at, std::span<std::byte> bytes) const;
  void set_size(std::uint64_t bytes);

  /// Upper bound of the bytes that are still to be written, for which room is made if the disk is full.
  void expect(std::uint64_t bytes) { to_come_ = bytes; }

 private:
  void make_room_for(std::uint64_t bytes) const;

  const Descriptor& file_;
  std::filesystem::path named_;
  MakeRoom make_room_;
  std::uint64_t to_come_ = 0;
};

}  // namespace clatter::storage
