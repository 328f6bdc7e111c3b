#include "storage/atomic_write.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>

#include "storage/error.hpp"
#include "storage/file_calls.hpp"
#include "storage/temporary_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::storage {
namespace {

namespace fs = std::filesystem;

void check_directory(const fs::path& path) {
  const fs::path directory = directory_of(path);
  struct stat status {};
  if (::stat(directory.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(path, errno);
    refuse(path, "there is no directory " + quoted_name(directory.string()), "make it with mkdir -p, or name another");
  }
  if (!S_ISDIR(status.st_mode)) refuse(path, ENOTDIR);
  if (::faccessat(AT_FDCWD, directory.c_str(), W_OK | X_OK, AT_EACCESS) != 0) refuse(path, errno);
}

/// As it was given: /dev/stdout leads to a place that has no name.
void check_kind(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return;
  if (S_ISDIR(status.st_mode)) refuse(path, "is a directory", "name a file in it");
  if (!S_ISREG(status.st_mode)) refuse(path, "is not a regular file, and would be replaced", "name a file");
}

void check_target(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(path, errno);
    return;
  }
  if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) {
    refuse(path, "an older file there is write-protected", "chmod u+w it, or name another");
  }
}

}  // namespace

void check_writable(const std::string& path) {
  if (path.empty()) throw IoError{"the output file has an empty name; name one"};
  check_kind(path);
  const fs::path target = target_of(path);
  check_target(target);
  check_directory(target);
}

void write_atomically(const std::string& path, const std::function<void(FileWriter&)>& write, const WriteSteps& steps) {
  check_writable(path);
  const fs::path target = target_of(path);
  remove_abandoned(target);
  TemporaryFile file{target};
  DiskWriter writer(file.descriptor(), target, steps.make_room);
  write(writer);
  file.sync();
  steps.before_rename();
  file.become_target();
  sync_directory(target);
}

void write_atomically(const std::string& path, std::string_view text, const WriteSteps& steps) {
  write_atomically(
      path, [text](FileWriter& file) { file.write(0, std::as_bytes(std::span(text))); }, steps);
}

}  // namespace clatter::storage
