#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace clatter::storage {

/// The regions of a scratch space that lie in files.
class MappedPages;

/// A part of a scratch space, zeros at first. Its memory or file goes with it.
class Region {
 public:
  Region(void* begin, std::size_t size, std::shared_ptr<MappedPages> pages);
  ~Region();
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;

  /// All of it as values of T, which has to be trivial.
  template <class T>
  [[nodiscard]] std::span<T> as() const {
    return {static_cast<T*>(begin_), size_ / sizeof(T)};
  }

 private:
  void* begin_;
  std::size_t size_;                    ///< bytes
  std::shared_ptr<MappedPages> pages_;  ///< none: it is in memory
};

/// Place for the results of a run until they are written: memory up to a limit, and beyond it files without a name
/// beside the output, whose pages the system keeps on the disk. Threads may use it at the same time.
class Scratch {
 public:
  static constexpr std::size_t most_in_memory = 344UL << 20U;  ///< bytes
  static constexpr std::size_t most_resident = 96UL << 20U;    ///< bytes of pages of the files
  static constexpr std::size_t between_checks = 16UL << 20U;   ///< bytes of pages, of all threads

  /// `output` is the file that the results are for; nothing: all is held in memory.
  explicit Scratch(const std::optional<std::filesystem::path>& output = {}, std::size_t in_memory = most_in_memory);

  /// Says that so many bytes are wanted; if they don't fit, the regions to come lie in files from the first on.
  void expect(double bytes);

  /// Throws std::bad_alloc, or an IoError that names the output if its disk is full.
  [[nodiscard]] std::shared_ptr<const Region> region(std::size_t bytes);
  /// A region in memory, however much is there.
  [[nodiscard]] static std::shared_ptr<const Region> region_in_memory(std::size_t bytes);

  /// Lets go of resident pages of the files once they are many. Call it when a thread has touched so many more pages.
  void touched(std::size_t pages) const {
    if (is_in_files_.load(std::memory_order_relaxed)) count(pages);
  }

 private:
  void count(std::size_t pages) const;
  [[nodiscard]] std::shared_ptr<const Region> region_in_file(std::size_t bytes);

  std::optional<std::filesystem::path> output_;
  std::size_t left_in_memory_;
  std::atomic<bool> is_in_files_ = false;
  std::mutex mutex_;
  std::shared_ptr<MappedPages> pages_;
};

/// Room in a scratch space for values of any lengths, one behind the other.
class Arena {
 public:
  explicit Arena(Scratch& scratch) : scratch_(scratch) {}

  /// Room for so many bytes, aligned for numbers, for the life of the arena. Threads may call it at the same time.
  [[nodiscard]] std::byte* room_for(std::size_t bytes);

 private:
  Scratch& scratch_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<const Region>> segments_;
  std::span<std::byte> left_;
  std::size_t size_ = 0;  ///< bytes of all segments
};

}  // namespace clatter::storage
