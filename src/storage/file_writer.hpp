#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "storage/file_calls.hpp"

namespace clatter::storage {

/// Frees disk space, if it can, in a file system that lacks so many bytes.
using MakeRoom = std::function<void(std::uint64_t bytes)>;

/// Frees nothing.
inline void no_room(std::uint64_t) {}

/// Free bytes in the file system of a file or its directory, quotas aside; the largest number if it doesn't tell.
[[nodiscard]] std::uint64_t room_at(const std::filesystem::path& path);

/// A file that is being made, and may be written at any place.
class FileWriter {
 public:
  virtual ~FileWriter() = default;

  virtual void write(std::uint64_t at, std::span<const std::byte> bytes) = 0;
  /// Beyond the end of the file, zeros.
  virtual void read(std::uint64_t at, std::span<std::byte> bytes) const = 0;
  virtual void set_size(std::uint64_t bytes) = 0;
  /// Tells an upper bound of the bytes that are still to be written.
  virtual void expect(std::uint64_t) {}
};

/// A file on a disk. If that is full, asks for the room that it lacks for all that is to come, and goes on. Throws an
/// IoError that names the file.
class DiskWriter final : public FileWriter {
 public:
  /// `file` is open for reading and writing, and has the name `named` in errors.
  DiskWriter(const Descriptor& file, std::filesystem::path named, MakeRoom make_room = no_room);

  void write(std::uint64_t at, std::span<const std::byte> bytes) override;
  void read(std::uint64_t at, std::span<std::byte> bytes) const override;
  void set_size(std::uint64_t bytes) override;
  void expect(std::uint64_t bytes) override { to_come_ = bytes; }

 private:
  void make_room_for(std::uint64_t bytes) const;

  const Descriptor& file_;
  std::filesystem::path named_;
  MakeRoom make_room_;
  std::uint64_t to_come_ = 0;
};

/// A file in memory.
class MemoryWriter final : public FileWriter {
 public:
  void write(std::uint64_t at, std::span<const std::byte> bytes) override;
  void read(std::uint64_t at, std::span<std::byte> bytes) const override;
  void set_size(std::uint64_t bytes) override { bytes_.resize(bytes); }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace clatter::storage
