#include "storage/file_calls.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>

#include "storage/error.hpp"
#include "storage/utf8.hpp"

namespace clatter::storage {

namespace fs = std::filesystem;

namespace {

std::string way_out_of(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space, or name a place that has more";
    case EACCES:
    case EPERM:
    case EROFS:
      return "get permission, or name a place where you have it";
    case ENAMETOOLONG:
      return "use a shorter name";
    default:
      return "name another output file";
  }
}

}  // namespace

void refuse(const fs::path& path, const std::string& why, const std::string& way_out) {
  throw IoError{"cannot write " + quoted_name(path.string()) + ": " + why + "; " + way_out};
}

void refuse(const fs::path& path, int error) {
  throw IoError{"cannot write " + quoted_name(path.string()) + ": " + reason_and_way_out(error, way_out_of(error))};
}

std::string reason_and_way_out(int error, const std::string& way_out) {
  rlimit limit{};
  if (error == EMFILE && ::getrlimit(RLIMIT_NOFILE, &limit) == 0)
    return "too many open files (ulimit -n is " + std::to_string(limit.rlim_cur) + "); raise it";
  if (error == ENFILE) return "the system has too many open files; end some processes, or try again later";
  return way_out.empty() ? std::strerror(error) : std::strerror(error) + ("; " + way_out);
}

fs::path target_of(fs::path path) {
  constexpr int most_links = 40;  // as in Linux's own look-up
  std::error_code error;
  for (int links = 0; fs::is_symlink(path, error); ++links) {
    if (links == most_links) refuse(path, ELOOP);
    path = path.parent_path() / fs::read_symlink(path, error);  // an absolute link replaces the parent
    if (error) refuse(path, error.value());
  }
  return path;
}

bool is_named(const Descriptor& file, const fs::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file.number(), &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

void sync_directory(const fs::path& file) {
  const Descriptor directory{::open(directory_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (directory.number() < 0 || uninterrupted([&] { return ::fsync(directory.number()); }) == 0) return;
  if (errno != EINVAL && errno != ENOTSUP) refuse(file, errno);
}

fs::path directory_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path{"."}; }

void write_all(const Descriptor& file, std::span<const std::byte> bytes, const fs::path& named) {
  while (!bytes.empty()) {
    const std::size_t next = std::min(bytes.size(), written_at_once);
    const ssize_t written = uninterrupted([&] { return ::write(file.number(), bytes.data(), next); });
    if (written < 0) refuse(named, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace clatter::storage
