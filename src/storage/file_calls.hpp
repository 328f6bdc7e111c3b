#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

namespace clatter::storage {

/// Throws the IoError of a file that cannot be written.
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why, const std::string& way_out);
[[noreturn]] void refuse(const std::filesystem::path& path, int error);

/// The reason why a system call failed, and the remedy: `way_out` (empty: none), but a remedy of its own if there are
/// too many open files.
[[nodiscard]] std::string reason_and_way_out(int error, const std::string& way_out);

/// Repeats a system call that a signal interrupted.
template <typename Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_{number} {}
  Descriptor(Descriptor&& other) noexcept : number_{std::exchange(other.number_, -1)} {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  [[nodiscard]] int number() const { return number_; }

  /// Closes now, since a network file system may report only here that the data didn't arrive. Never repeated, as Linux
  /// always closes.
  [[nodiscard]] bool close() { return ::close(std::exchange(number_, -1)) == 0 || errno == EINTR; }

 private:
  int number_;
};

/// Whether `path` still names an open file.
[[nodiscard]] bool is_named(const Descriptor& file, const std::filesystem::path& path);

/// Makes a new or changed name in the directory of a file survive a power cut, if the directory can be opened and
/// synced.
void sync_directory(const std::filesystem::path& file);

/// The end of a chain of symbolic links, whether there is a file or not.
[[nodiscard]] std::filesystem::path target_of(std::filesystem::path path);

[[nodiscard]] std::filesystem::path directory_of(const std::filesystem::path& path);

/// The most bytes for one call: for more, Linux takes large pages for its cache, and on a virtual machine the host
/// often has to provide these first, at ten times the cost.
inline constexpr std::size_t written_at_once = 64UL * 1024;

/// Writes all of the bytes. Throws an IoError that names the file `named`.
void write_all(const Descriptor& file, std::span<const std::byte> bytes, const std::filesystem::path& named);

}  // namespace clatter::storage
