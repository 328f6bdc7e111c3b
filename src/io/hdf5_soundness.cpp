#include "io/hdf5_soundness.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/hdf5_handle.hpp"

namespace clatter::hdf5 {
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

/// Walks the objects as the library does; true where every step leads forward and none beyond the end.
bool is_sound(std::string_view objects) {
  while (objects.size() >= header) {
    const auto index = little_endian<std::uint16_t>(objects);
    const auto size = little_endian<std::uint64_t>(objects.substr(8));
    if (size > objects.size()) return false;
    const std::uint64_t step = index == 0 ? size : header + (size + 7) / 8 * 8;  // 0: the free rest, header included
    if (step == 0 || step > objects.size()) return false;
    objects.remove_prefix(step);
  }
  return true;
}

/// A file's bytes in memory; none where the system cannot give them, and HDF5 then says why.
class Mapping {
 public:
  explicit Mapping(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    struct stat status {};
    if (::fstat(file, &status) == 0 && status.st_size > 0) {
      size_ = static_cast<std::size_t>(status.st_size);
      bytes_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    }
    ::close(file);
  }
  ~Mapping() {
    if (bytes_ != MAP_FAILED) ::munmap(bytes_, size_);
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  [[nodiscard]] std::string_view bytes() const {
    return bytes_ == MAP_FAILED ? std::string_view{} : std::string_view{static_cast<const char*>(bytes_), size_};
  }

 private:
  void* bytes_ = MAP_FAILED;
  std::size_t size_ = 0;
};

}  // namespace

void require_sound_heaps(const std::string& path) {
  const Mapping file{path};
  for (std::size_t at = 0; (at = file.bytes().find(signature, at)) != std::string_view::npos; at += header) {
    const std::string_view rest = file.bytes().substr(at);
    if (rest.size() < header) return;
    const auto size = little_endian<std::uint64_t>(rest.substr(8));
    if (size < header || size > rest.size() || !is_sound(rest.substr(header, size - header))) {
      throw Failure{"a heap of texts at byte " + std::to_string(at) + " is damaged"};
    }
  }
}

}  // namespace clatter::hdf5
