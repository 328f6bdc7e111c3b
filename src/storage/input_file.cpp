#include "storage/input_file.hpp"

#include <fcntl.h>

#include <cerrno>

#include "storage/error.hpp"
#include "storage/utf8.hpp"

namespace clatter::storage {

void refuse_reading(const std::string& path, const std::string& why, const std::string& way_out) {
  throw IoError(quoted_name(path) + ": " + why + "; " + way_out);
}

std::uint64_t stored_bytes(const struct stat& status) {
  constexpr blkcnt_t block = 512;  // bytes, as Linux counts them
  return static_cast<std::uint64_t>(status.st_blocks > 0 ? block * status.st_blocks : status.st_size);
}

InputFile open_input(const std::string& path, const std::string& wanted) {
  Descriptor file{uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); })};
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) {
    const char* const way_out = errno == EACCES ? "get permission to read it" : "check the name";
    throw IoError(quoted_name(path) + ": " + reason_and_way_out(errno, way_out));
  }
  if (S_ISDIR(status.st_mode)) refuse_reading(path, "is a directory", "name a file in it");
  if (!S_ISREG(status.st_mode)) refuse_reading(path, "is not a regular file", "name " + wanted);
  return {std::move(file), stored_bytes(status)};
}

}  // namespace clatter::storage
