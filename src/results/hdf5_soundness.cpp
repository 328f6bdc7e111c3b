#include "results/hdf5_soundness.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "results/hdf5_handle.hpp"
#include "storage/file_calls.hpp"

namespace clatter::results::detail {
namespace {

using namespace std::string_view_literals;

// HDF5 file format, III.E "Disk Format: Level 1E - Global Heap": a collection is signature, version, size, then
// objects, each of a header {index 2, references 2, reserved 4, size 8} and its data.
constexpr std::string_view signature = "GCOL\1\0\0\0"sv;
constexpr std::size_t header = 16;

template <typename Integer>
Integer little_endian(std::string_view bytes) {
  Integer value = 0;
  for (std::size_t i = sizeof(Integer); i-- > 0;) {
    value = static_cast<Integer>(static_cast<Integer>(value << 8U) | static_cast<unsigned char>(bytes[i]));
  }
  return value;
}

/// Reads parts of a file; a part is cut at the end of the file.
class Parts {
 public:
  explicit Parts(const std::string& path) : file_{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)} {
    struct stat status {};
    if (file_.number() < 0 || ::fstat(file_.number(), &status) != 0) throw Failure{"it cannot be opened"};
    size_ = static_cast<std::uint64_t>(status.st_size);
  }

  [[nodiscard]] std::uint64_t size() const { return size_; }

  [[nodiscard]] std::string_view read(std::uint64_t begin, std::span<char> to) const {
    std::size_t got = 0;
    while (got < to.size()) {
      const ssize_t more = storage::uninterrupted(
          [&] { return ::pread(file_.number(), to.data() + got, to.size() - got, static_cast<off_t>(begin + got)); });
      if (more < 0) throw Failure{"it cannot be read"};
      if (more == 0) break;
      got += static_cast<std::size_t>(more);
    }
    return {to.data(), got};
  }

  /// The next byte from `begin` on that is stored, else the end of the file. The hole before it reads as zeros, and may
  /// be far longer than the disk.
  [[nodiscard]] std::uint64_t next_stored(std::uint64_t begin) const {
    const off_t data = ::lseek(file_.number(), static_cast<off_t>(begin), SEEK_DATA);
    if (data < 0) return errno == ENXIO ? size_ : begin;  // some file systems don't tell
    return static_cast<std::uint64_t>(data);
  }

 private:
  storage::Descriptor file_;
  std::uint64_t size_ = 0;
};

/// Walks the objects from `at` to `end` as the library does; true if every step leads forward and none beyond the end.
bool is_sound(const Parts& file, std::uint64_t at, std::uint64_t end) {
  std::array<char, header> bytes{};
  while (end - at >= header) {
    const std::string_view object = file.read(at, bytes);
    if (object.size() < header) return false;
    const auto index = little_endian<std::uint16_t>(object);
    const auto size = little_endian<std::uint64_t>(object.substr(8));
    if (size > end - at) return false;
    const std::uint64_t step = index == 0 ? size : header + (size + 7) / 8 * 8;  // 0: the free rest, header included
    if (step == 0 || step > end - at) return false;
    at += step;
  }
  return true;
}

void require_sound_heap(const Parts& file, std::uint64_t at) {
  std::array<char, header> bytes{};
  const std::string_view collection = file.read(at, bytes);
  if (collection.size() < header) return;
  const auto size = little_endian<std::uint64_t>(collection.substr(8));
  if (size < header || size > file.size() - at || !is_sound(file, at + header, at + size))
    throw Failure{"a heap of texts at byte " + std::to_string(at) + " is damaged"};
}

}  // namespace

void require_sound_heaps(const std::string& path) {
  const Parts file{path};
  constexpr std::size_t overlap = signature.size() - 1;
  std::vector<char> piece(std::size_t{1} << 20U);
  for (std::uint64_t begin = file.next_stored(0); begin < file.size(); begin = file.next_stored(begin)) {
    const std::string_view bytes = file.read(begin, piece);
    for (std::size_t at = 0; (at = bytes.find(signature, at)) != std::string_view::npos; at += header)
      require_sound_heap(file, begin + at);
    if (bytes.size() < piece.size()) return;  // the end
    begin += bytes.size() - overlap;
  }
}

}  // namespace clatter::results::detail
