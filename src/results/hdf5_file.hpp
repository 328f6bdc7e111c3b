#pragma once

#include <hdf5.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <span>

#include "results/hdf5_handle.hpp"
#include "storage/file_writer.hpp"

namespace clatter::results::detail {

/// A file that HDF5 makes, written in whole pages, so that a small file is written at once. HDF5 never sees an error of
/// the disk, after which it would leave the file half open and may crash at exit: the error is kept for `finish`.
class FileInPages {
 public:
  explicit FileInPages(storage::FileWriter& file) : file_(file) {}
  FileInPages(const FileInPages&) = delete;
  FileInPages& operator=(const FileInPages&) = delete;

  /// Creates the file, with the properties of creation and access given.
  [[nodiscard]] Handle create(hid_t creation, hid_t access);

  /// Values for H5Dwrite that only give a contiguous variable its place in the file; its values are then written by
  /// `write`. They need more than a sieve buffer of HDF5 (64 KiB), or it would read them.
  [[nodiscard]] static const void* place_only();
  static constexpr std::size_t least_placed = 128UL * 1024;  ///< bytes

  /// Tells an upper bound of the bytes that are still to be passed to `write`.
  void expect(std::uint64_t bytes) { to_come_ = bytes; }
  void write(std::uint64_t at, std::span<const std::byte> bytes);
  void read(std::uint64_t at, std::span<std::byte> bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  void set_size(std::uint64_t bytes) { size_ = bytes; }

  /// Throws the error that has occurred, if any has.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }
  /// Writes the rest; call it once the file is closed. Throws IoError, std::bad_alloc.
  void finish();

 private:
  static constexpr std::size_t page_size = storage::written_at_once;
  static constexpr std::size_t most_pages = 16;
  using Page = std::array<std::byte, page_size>;

  [[nodiscard]] Page& page(std::uint64_t number);
  [[nodiscard]] std::uint64_t bytes_of(std::uint64_t number) const;
  void expect_on_disk(std::uint64_t bytes) const;
  void write_pages();

  storage::FileWriter& file_;
  std::map<std::uint64_t, Page> pages_;  ///< by number; not yet written
  std::uint64_t size_ = 0;               ///< of the file, as HDF5 tells it
  std::uint64_t written_ = 0;            ///< end of what was ever written to the disk
  std::uint64_t to_come_ = 0;            ///< bytes, at most
  std::exception_ptr error_;
};

}  // namespace clatter::results::detail
