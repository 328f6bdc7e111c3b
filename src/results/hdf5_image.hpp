#pragma once

#include <hdf5.h>

#include <cstddef>
#include <span>

namespace clatter::results::detail {

/// Owns the memory in which the core driver builds a file, from the closing of the file on: H5Fget_file_image would
/// take the size of the file once more. Has to outlive the file.
class Image {
 public:
  Image() = default;
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  /// Makes files that are created with `access` leave their memory here when they are closed.
  void receive_from(hid_t access);

  /// The first `size` bytes, since the driver allocates more than the file has; empty until the file is closed.
  [[nodiscard]] std::span<const std::byte> first(std::size_t size) const;

  /// Puts bytes behind the first `size` bytes; returns both. Throws std::bad_alloc.
  std::span<const std::byte> append(std::size_t size, std::span<const std::byte> bytes);

 private:
  void* bytes_ = nullptr;
};

}  // namespace clatter::results::detail
