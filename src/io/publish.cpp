#include "io/publish.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <random>
#include <string>
#include <utility>

#include "io/error.hpp"
#include "io/file_calls.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;

void check_directory(const fs::path& path) {
  const fs::path directory = directory_of(path);
  struct stat status {};
  if (::stat(directory.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(path, errno);
    refuse(path, "there is no directory '" + directory.string() + "'", "make it with mkdir -p, or name another");
  }
  if (!S_ISDIR(status.st_mode)) refuse(path, ENOTDIR);
  if (::faccessat(AT_FDCWD, directory.c_str(), W_OK | X_OK, AT_EACCESS) != 0) refuse(path, errno);
}

void check_target(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(path, errno);
    return;
  }
  if (S_ISDIR(status.st_mode)) refuse(path, "is a directory", "name a file in it");
  if (!S_ISREG(status.st_mode)) refuse(path, "is not a regular file, and would be replaced", "name a file");
  if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) {
    refuse(path, "an older file there is write-protected", "chmod u+w it, or name another");
  }
}

constexpr std::string_view temporary_ending = ".tmp";
constexpr std::size_t temporary_letters = 6;

/// A hidden name beside the target, since rename is atomic only within one file system; this is how it begins.
std::string temporary_prefix(const fs::path& target) {
  constexpr std::size_t longest = 200;  // leaves room for the rest of the 255 bytes of a name
  return std::string{'.'}.append(target.filename().string(), 0, longest).append(1, '.');
}

fs::path temporary_name(const fs::path& target) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::uniform_int_distribution<std::size_t> letter{0, letters.size() - 1};
  std::string name = temporary_prefix(target);
  for (std::size_t i = 0; i < temporary_letters; ++i) name += letters[letter(random)];
  return directory_of(target) / name.append(temporary_ending);
}

bool lock(const Descriptor& file) {
  return uninterrupted([&] { return ::flock(file.number(), LOCK_EX | LOCK_NB); }) == 0;
}

/// Removes what a killed process has left under a temporary name of this target: the file of one that lives is locked.
void remove_abandoned(const fs::path& target) {
  const std::string prefix = temporary_prefix(target);
  std::error_code error;
  for (fs::directory_iterator entry(directory_of(target), error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(temporary_ending) ||
        name.size() != prefix.size() + temporary_letters + temporary_ending.size())
      continue;
    const Descriptor file{::open(entry->path().c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW)};
    if (file.number() >= 0 && lock(file)) ::unlink(entry->path().c_str());
  }
}

/// A new file that is removed again unless it has been renamed to its target.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path target)
      : target_{std::move(target)}, path_{temporary_name(target_)}, file_{create()} {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  void write(std::span<const std::byte> bytes) { write_all(file_, bytes, target_); }

  void sync() {
    if (uninterrupted([&] { return ::fsync(file_.number()); }) != 0 || !file_.close()) refuse(target_, errno);
  }

  void become_target() {
    if (::rename(path_.c_str(), target_.c_str()) != 0) refuse(target_, errno);
    path_.clear();
  }

 private:
  /// Creates the file with the permissions that any new file of the user's has; O_EXCL, so that no other run's is
  /// taken.
  Descriptor create() {
    for (;; path_ = temporary_name(target_)) {
      Descriptor file{
          uninterrupted([&] { return ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); })};
      if (file.number() < 0 && errno != EEXIST) refuse(target_, errno);
      // Another process may take it for abandoned before it is locked.
      if (file.number() >= 0 && (lock(file) || errno != EWOULDBLOCK) && is_named(file, path_)) return file;
    }
  }

  fs::path target_, path_;
  Descriptor file_;
};

}  // namespace

void check_writable(const std::string& path) {
  if (path.empty()) throw IoError{"the output file has an empty name; name one"};
  const fs::path target = target_of(path);
  check_target(target);
  check_directory(target);
}

void publish(const std::string& path, std::span<const std::byte> bytes, const std::function<void()>& before_rename) {
  check_writable(path);
  const fs::path target = target_of(path);
  remove_abandoned(target);
  TemporaryFile file{target};
  file.write(bytes);
  file.sync();
  before_rename();
  file.become_target();
  sync_directory(target);
}

}  // namespace clatter
