#include "storage/file_writer.hpp"

#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <utility>

namespace clatter::storage {

namespace fs = std::filesystem;

std::uint64_t room_at(const fs::path& path) {
  struct statvfs system {};
  if (::statvfs(directory_of(path).c_str(), &system) != 0) return std::numeric_limits<std::uint64_t>::max();
  return std::uint64_t{system.f_bavail} * system.f_frsize;
}

DiskWriter::DiskWriter(const Descriptor& file, fs::path named, MakeRoom make_room)
    : file_(file), named_(std::move(named)), make_room_(std::move(make_room)) {}

void DiskWriter::write(std::uint64_t at, std::span<const std::byte> bytes) {
  for (bool has_asked = false; !bytes.empty();) {
    const std::size_t next = std::min(bytes.size(), written_at_once);
    const ssize_t written =
        uninterrupted([&] { return ::pwrite(file_.number(), bytes.data(), next, static_cast<off_t>(at)); });
    if (written < 0) {
      const int error = errno;
      if ((error != ENOSPC && error != EDQUOT) || has_asked) refuse(named_, error);
      has_asked = true;
      make_room_for(std::max<std::uint64_t>(bytes.size(), to_come_));
      continue;
    }
    has_asked = false;
    to_come_ -= std::min(to_come_, static_cast<std::uint64_t>(written));
    at += static_cast<std::uint64_t>(written), bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void DiskWriter::make_room_for(std::uint64_t bytes) const {
  const std::uint64_t needed = bytes + bytes / 64 + 64UL * 1024;  // with the file system's own records
  if (const std::uint64_t room = room_at(named_); room < needed) make_room_(needed - room);
}

void DiskWriter::read(std::uint64_t at, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got =
        uninterrupted([&] { return ::pread(file_.number(), bytes.data(), bytes.size(), static_cast<off_t>(at)); });
    if (got < 0) refuse(named_, errno);
    if (got == 0) break;
    at += static_cast<std::uint64_t>(got), bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  std::ranges::fill(bytes, std::byte{});
}

void DiskWriter::set_size(std::uint64_t bytes) {
  if (uninterrupted([&] { return ::ftruncate(file_.number(), static_cast<off_t>(bytes)); }) != 0) refuse(named_, errno);
}

void MemoryWriter::write(std::uint64_t at, std::span<const std::byte> bytes) {
  bytes_.resize(std::max<std::size_t>(bytes_.size(), at + bytes.size()));
  std::ranges::copy(bytes, bytes_.begin() + static_cast<std::ptrdiff_t>(at));
}

void MemoryWriter::read(std::uint64_t at, std::span<std::byte> bytes) const {
  const std::size_t there = std::min(bytes.size(), bytes_.size() - std::min<std::size_t>(at, bytes_.size()));
  std::ranges::copy(std::span(bytes_).subspan(there > 0 ? at : 0, there), bytes.begin());
  std::ranges::fill(bytes.subspan(there), std::byte{});
}

}  // namespace clatter::storage
