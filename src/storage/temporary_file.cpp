#include "storage/temporary_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace clatter::storage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_mark = ".clatter-", temporary_ending = ".tmp";
constexpr std::size_t temporary_letters = 8;

/// The beginning of a hidden name beside the target: rename is atomic only within one file system.
std::string temporary_prefix(const fs::path& target) {
  constexpr std::size_t longest = 200;  // leaves room for the rest of the 255 bytes of a name
  return std::string{'.'}.append(target.filename().string(), 0, longest).append(temporary_mark);
}

fs::path temporary_name(const fs::path& target) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::uniform_int_distribution<std::size_t> letter{0, letters.size() - 1};
  std::string name = temporary_prefix(target);
  for (std::size_t i = 0; i < temporary_letters; ++i) name += letters[letter(random)];
  return directory_of(target) / name.append(temporary_ending);
}

bool is_temporary_name(const std::string& name, const std::string& prefix) {
  return name.starts_with(prefix) && name.ends_with(temporary_ending) &&
         name.size() == prefix.size() + temporary_letters + temporary_ending.size();
}

bool lock(const Descriptor& file) {
  return uninterrupted([&] { return ::flock(file.number(), LOCK_EX | LOCK_NB); }) == 0;
}

/// Whether a file may be the beginning of an output: empty, or with the first bytes of HDF5.
bool begins_as_output(const Descriptor& file) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::array<char, signature.size()> first{};
  const ssize_t got = uninterrupted([&] { return ::pread(file.number(), first.data(), first.size(), 0); });
  return got >= 0 && signature.starts_with(std::string_view(first.data(), static_cast<std::size_t>(got)));
}

/// Whether a killed process of this user has left the file: that of a living one is locked.
bool is_abandoned(const Descriptor& file) {
  struct stat status {};
  return ::fstat(file.number(), &status) == 0 && S_ISREG(status.st_mode) &&
         (status.st_uid == ::geteuid() || ::geteuid() == 0) && begins_as_output(file) && lock(file);
}

/// Owner, group and mode of a file.
struct Access {
  mode_t mode;
  uid_t owner;
  gid_t group;
};

/// The access of the file at `path`; nothing if there is no file.
std::optional<Access> access_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return Access{status.st_mode & 0777, status.st_uid, status.st_gid};
}

/// Gives a file the owner, group and mode of the one it replaces, as far as that is permitted. If the group can't be
/// kept, the file's own group gets no more than others have.
void take_over(const Descriptor& file, const Access& access) {
  mode_t mode = access.mode;
  if (::fchown(file.number(), access.owner, access.group) != 0 &&
      ::fchown(file.number(), static_cast<uid_t>(-1), access.group) != 0)
    mode &= 0707U | (mode & 07U) << 3U;
  (void)::fchmod(file.number(), mode);  // some file systems have no modes
}

}  // namespace

void remove_abandoned(const fs::path& target) {
  const std::string prefix = temporary_prefix(target);
  std::error_code error;
  for (fs::directory_iterator entry(directory_of(target), error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code unknown;
    if (!is_temporary_name(path.filename().string(), prefix) ||
        entry->symlink_status(unknown).type() != fs::file_type::regular)
      continue;
    const Descriptor file{::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)};
    if (file.number() >= 0 && is_abandoned(file) && is_named(file, path)) ::unlink(path.c_str());
  }
}

Descriptor nameless_file(const fs::path& directory, mode_t mode) {
  return Descriptor{uninterrupted([&] { return ::open(directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode); })};
}

TemporaryFile::TemporaryFile(fs::path target) : target_{std::move(target)}, file_{create()} {}

TemporaryFile::~TemporaryFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

void TemporaryFile::sync() {
  if (uninterrupted([&] { return ::fsync(file_.number()); }) != 0) refuse(target_, errno);
}

void TemporaryFile::become_target() {
  if (const std::optional<Access> older = access_of(target_)) take_over(file_, *older);
  if (path_.empty()) give_name();
  if (::rename(path_.c_str(), target_.c_str()) != 0) refuse(target_, errno);
  path_.clear();
}

namespace {

/// The file that a descriptor has open, as a path.
std::string path_of(const Descriptor& file) { return "/proc/self/fd/" + std::to_string(file.number()); }

}  // namespace

/// Only a file with a name can replace another one.
void TemporaryFile::give_name() {
  for (;;) {
    fs::path name = temporary_name(target_);
    if (::linkat(AT_FDCWD, path_of(file_).c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      path_ = std::move(name);
      return;
    }
    if (errno != EEXIST) refuse(target_, errno);
  }
}

/// Creates the file with the permissions of a new file, or closed to others until it takes over those of an older one.
Descriptor TemporaryFile::create() {
  const std::optional<Access> older = access_of(target_);
  const mode_t mode = older ? (older->mode & 0666U) | 0600U : 0666U;
  Descriptor file = create_nameless(mode);
  return file.number() >= 0 ? std::move(file) : create_named(mode);
}

/// No file, if there can't be one that gets a name later.
Descriptor TemporaryFile::create_nameless(mode_t mode) const {
  Descriptor file = nameless_file(directory_of(target_), mode);
  if (file.number() < 0) {
    if (errno != EOPNOTSUPP && errno != EISDIR && errno != ENOENT && errno != EINVAL) refuse(target_, errno);
  } else if (::access(path_of(file).c_str(), F_OK) != 0 || (!lock(file) && errno == EWOULDBLOCK)) {
    return Descriptor{-1};
  }
  return file;
}

/// O_EXCL, so that it is never another run's file.
Descriptor TemporaryFile::create_named(mode_t mode) {
  for (;;) {
    path_ = temporary_name(target_);
    Descriptor file{uninterrupted([&] { return ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode); })};
    if (file.number() < 0 && errno != EEXIST) {
      const int error = errno;
      path_.clear();
      refuse(target_, error);
    }
    // Another process may take it for abandoned before it is locked.
    if (file.number() >= 0 && (lock(file) || errno != EWOULDBLOCK) && is_named(file, path_)) return file;
  }
}

}  // namespace clatter::storage
