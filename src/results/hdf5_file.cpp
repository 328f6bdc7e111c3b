#include "results/hdf5_file.hpp"

#include <algorithm>

namespace clatter::results::detail {
namespace {

/// What HDF5 calls an open file: its own part has to come first.
struct OpenFile {
  H5FD_t own;
  FileInPages* file;
};

FileInPages& file_of(H5FD_t* open) { return *reinterpret_cast<OpenFile*>(open)->file; }
const FileInPages& file_of(const H5FD_t* open) { return *reinterpret_cast<const OpenFile*>(open)->file; }

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* const file = static_cast<FileInPages* const*>(H5Pget_driver_info(access));
  return file == nullptr ? nullptr : &(new OpenFile{{}, *file})->own;
}

herr_t close_file(H5FD_t* open) {
  delete reinterpret_cast<OpenFile*>(open);
  return 0;
}

/// As of HDF5's own driver of files in memory, so that variables lie at the same places as in files that it made.
herr_t query(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t size_of(const H5FD_t* open, H5FD_mem_t) { return file_of(open).size(); }

herr_t set_size(H5FD_t* open, H5FD_mem_t, haddr_t bytes) {
  file_of(open).set_size(bytes);
  return 0;
}

herr_t read(H5FD_t* open, H5FD_mem_t, hid_t, haddr_t at, size_t size, void* bytes) {
  file_of(open).read(at, {static_cast<std::byte*>(bytes), size});
  return 0;
}

herr_t write(H5FD_t* open, H5FD_mem_t, hid_t, haddr_t at, size_t size, const void* bytes) {
  if (bytes != FileInPages::place_only()) file_of(open).write(at, {static_cast<const std::byte*>(bytes), size});
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "clatter", driver.maxaddr = INT64_MAX, driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(FileInPages*);
  driver.open = open_file, driver.close = close_file, driver.query = query;
  driver.get_eoa = size_of, driver.set_eoa = set_size, driver.get_eof = size_of;
  driver.read = read, driver.write = write;
  constexpr std::array kinds H5FD_FLMAP_DICHOTOMY;
  std::ranges::copy(kinds, driver.fl_map);
  return driver;
}

}  // namespace

Handle FileInPages::create(hid_t creation, hid_t access) {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = checked(H5FDregister(&driver));
  FileInPages* const self = this;
  checked(H5Pset_driver(access, id, &self));
  return {H5Fcreate("clatter.h5", H5F_ACC_TRUNC, creation, access), H5Fclose};
}

const void* FileInPages::place_only() {
  static const std::byte place{};
  return &place;
}

FileInPages::Page& FileInPages::page(std::uint64_t number) {
  if (const auto found = pages_.find(number); found != pages_.end()) return found->second;
  if (pages_.size() >= most_pages) write_pages();
  Page& page = pages_[number];
  if (number * page_size < written_) file_.read(number * page_size, page);
  return page;
}

/// The bytes of a page within the file.
std::uint64_t FileInPages::bytes_of(std::uint64_t number) const {
  const std::uint64_t begin = number * page_size;
  return begin < size_ ? std::min<std::uint64_t>(page_size, size_ - begin) : 0;
}

/// Tells the disk that so many bytes follow, and all pages and what is still to come: it frees room for all, or none.
void FileInPages::expect_on_disk(std::uint64_t bytes) const {
  for (const auto& [number, page] : pages_) bytes += bytes_of(number);
  file_.expect(to_come_ + bytes);
}

void FileInPages::write(std::uint64_t at, std::span<const std::byte> bytes) {
  if (error_) return;
  to_come_ -= std::min<std::uint64_t>(to_come_, bytes.size());
  try {
    while (!bytes.empty()) {
      const std::uint64_t number = at / page_size, within = at % page_size;
      const std::size_t some = std::min<std::size_t>(bytes.size(), page_size - within);
      if (some == page_size) {
        pages_.erase(number);
        expect_on_disk(bytes.size());
        file_.write(at, bytes.first(some));
        written_ = std::max(written_, at + some);
      } else {
        std::ranges::copy(bytes.first(some), page(number).begin() + static_cast<std::ptrdiff_t>(within));
      }
      at += some, bytes = bytes.subspan(some);
    }
  } catch (...) {
    error_ = std::current_exception();
  }
}

void FileInPages::read(std::uint64_t at, std::span<std::byte> bytes) {
  try {
    while (!bytes.empty()) {
      const std::uint64_t number = at / page_size, within = at % page_size;
      const std::size_t some = std::min<std::size_t>(bytes.size(), page_size - within);
      const auto begin = page(number).begin() + static_cast<std::ptrdiff_t>(within);
      std::copy(begin, begin + static_cast<std::ptrdiff_t>(some), bytes.begin());
      at += some, bytes = bytes.subspan(some);
    }
  } catch (...) {
    error_ = std::current_exception();
    std::ranges::fill(bytes, std::byte{});
  }
}

void FileInPages::write_pages() {
  expect_on_disk(0);
  for (const auto& [number, page] : pages_) {
    const std::uint64_t begin = number * page_size;
    const auto some = static_cast<std::size_t>(bytes_of(number));
    if (some == 0) break;
    file_.write(begin, std::span(page).first(some));
    written_ = std::max(written_, begin + some);
  }
  pages_.clear();
}

void FileInPages::finish() {
  rethrow();
  write_pages();
  file_.set_size(size_);
}

}  // namespace clatter::results::detail
