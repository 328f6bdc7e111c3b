#include "storage/scratch.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <new>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "storage/file_calls.hpp"
#include "storage/temporary_file.hpp"

namespace clatter::storage {

namespace fs = std::filesystem;

class MappedPages {
 public:
  void add(std::span<std::byte> region) {
    const std::lock_guard lock(mutex_);
    regions_.insert({region.data(), region.size()});
  }
  void remove(std::span<std::byte> region) {
    const std::lock_guard lock(mutex_);
    regions_.erase({region.data(), region.size()});
  }
  /// The pages stay in the system's cache, and come back when they are touched.
  void let_go() {
    const std::lock_guard lock(mutex_);
    for (const auto& [begin, size] : regions_) ::madvise(begin, size, MADV_DONTNEED);
  }

 private:
  std::mutex mutex_;
  std::set<std::pair<std::byte*, std::size_t>> regions_;
};

namespace {

/// Bytes of the pages of files that are resident, those of the program among them.
std::size_t resident_of_files() {
  std::ifstream statm("/proc/self/statm");
  std::size_t all = 0, resident = 0, of_files = 0;
  statm >> all >> resident >> of_files;
  return of_files * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// A file without a name in a directory, all of its space reserved: a full disk is told now, not when a page is
/// written.
Descriptor reserved_file(const fs::path& output, std::size_t bytes) {
  const fs::path directory = directory_of(output);
  Descriptor file = nameless_file(directory, 0600);
  if (file.number() < 0) {  // some network file systems have no such files
    std::string name = (directory / ".clatter-XXXXXX").string();
    file = Descriptor{::mkostemp(name.data(), O_CLOEXEC)};
    if (file.number() < 0) refuse(output, errno);
    ::unlink(name.c_str());
  }
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(file.number(), 0, static_cast<off_t>(bytes));
  if (error != 0) refuse(output, error);
  return file;
}

}  // namespace

Region::Region(void* begin, std::size_t size, std::shared_ptr<MappedPages> pages)
    : begin_(begin), size_(size), pages_(std::move(pages)) {
  if (pages_) pages_->add(as<std::byte>());
}

Region::~Region() {
  if (pages_) {
    pages_->remove(as<std::byte>());
    ::munmap(begin_, size_);
  } else {
    std::free(begin_);
  }
}

Scratch::Scratch(const std::optional<fs::path>& output, std::size_t in_memory)
    : left_in_memory_(in_memory), pages_(std::make_shared<MappedPages>()) {
  if (output) output_ = target_of(*output);
}

void Scratch::expect(double bytes) {
  if (output_ && bytes > static_cast<double>(left_in_memory_)) left_in_memory_ = 0;
}

std::shared_ptr<const Region> Scratch::region(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (output_ && bytes > left_in_memory_) return region_in_file(bytes);
  if (output_) left_in_memory_ -= bytes;
  return region_in_memory(bytes);
}

std::shared_ptr<const Region> Scratch::region_in_memory(std::size_t bytes) {
  void* const begin = std::calloc(std::max<std::size_t>(bytes, 1), 1);
  if (begin == nullptr) throw std::bad_alloc();
  return std::make_shared<const Region>(begin, bytes, nullptr);
}

std::shared_ptr<const Region> Scratch::region_in_file(std::size_t bytes) {
  const Descriptor file = reserved_file(*output_, bytes);
  void* const begin = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.number(), 0);
  if (begin == MAP_FAILED) throw std::bad_alloc();
  is_in_files_ = true;
  return std::make_shared<const Region>(begin, bytes, pages_);
}

void Scratch::count(std::size_t pages) const {
  static thread_local std::size_t of_this_thread = 0;
  static const std::size_t most_of_thread = between_checks / std::max(1U, std::thread::hardware_concurrency());
  constexpr std::size_t page = 4096;
  of_this_thread += pages * page;
  if (of_this_thread < most_of_thread) return;
  of_this_thread = 0;
  if (resident_of_files() > most_resident) pages_->let_go();
}

std::byte* Arena::room_for(std::size_t bytes) {
  constexpr std::size_t least = 64UL << 10U, most = 64UL << 20U, alignment = alignof(double);
  bytes = (bytes + alignment - 1) / alignment * alignment;
  const std::lock_guard lock(mutex_);
  if (bytes > left_.size()) {
    segments_.push_back(scratch_.region(std::max(bytes, std::clamp(size_ / 4, least, most))));
    left_ = segments_.back()->as<std::byte>();
    size_ += left_.size();
  }
  std::byte* const room = left_.data();
  left_ = left_.subspan(bytes);
  return room;
}

}  // namespace clatter::storage
