#include "results/hdf5_image.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

#include "results/hdf5_handle.hpp"

namespace clatter::results::detail {
namespace {

/// Allocates memory that this program may free; only HDF5 may free its own.
void* grow(void* bytes, std::size_t size, H5FD_file_image_op_t, void*) { return std::realloc(bytes, size); }

/// Called when the file is closed, instead of freeing the memory.
herr_t leave(void* bytes, H5FD_file_image_op_t, void* place) {
  *static_cast<void**>(place) = bytes;
  return 0;
}

/// Property lists and drivers copy the argument of callbacks: here all copies are the same pointer.
void* same(void* place) { return place; }

/// So freeing a copy frees nothing.
herr_t keep(void*) { return 0; }

}  // namespace

Image::~Image() { std::free(bytes_); }

void Image::receive_from(hid_t access) {
  H5FD_file_image_callbacks_t callbacks{nullptr, nullptr, grow, leave, same, keep, &bytes_};
  checked(H5Pset_file_image_callbacks(access, &callbacks));
}

std::span<const std::byte> Image::first(std::size_t size) const {
  return {static_cast<const std::byte*>(bytes_), bytes_ == nullptr ? 0 : size};
}

std::span<const std::byte> Image::append(std::size_t size, std::span<const std::byte> bytes) {
  void* const longer = std::realloc(bytes_, size + bytes.size());
  if (longer == nullptr) throw std::bad_alloc();
  bytes_ = longer;
  std::ranges::copy(bytes, static_cast<std::byte*>(bytes_) + size);
  return first(size + bytes.size());
}

}  // namespace clatter::results::detail
