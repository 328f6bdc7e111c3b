#include "storage/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "storage/error.hpp"
#include "storage/free_name.hpp"
#include "storage/input_file.hpp"
#include "storage/journal_blocks.hpp"
#include "storage/utf8.hpp"

namespace clatter::storage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "clatter journal 1\n";

/// No header is longer: configurations are far shorter than that.
constexpr double most_header = 8UL * 1024 * 1024;  // bytes

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

Bytes bytes_of(const JournalKey& key) {
  Bytes bytes;
  for (const std::string* text : {&key.program, &key.rounding, &key.shard, &key.config})
    append_number(bytes, std::uint64_t{text->size()}), append_bytes(bytes, bytes_of(*text));
  return bytes;
}

/// The key in a header that its CRC has confirmed; nothing if its lengths don't fit.
std::optional<JournalKey> key_of(std::span<const std::byte> bytes) {
  JournalKey key;
  for (std::string* text : {&key.program, &key.rounding, &key.shard, &key.config}) {
    std::uint64_t length = 0;
    if (bytes.size() < sizeof length) return std::nullopt;
    std::memcpy(&length, bytes.data(), sizeof length);
    bytes = bytes.subspan(sizeof length);
    if (length > bytes.size()) return std::nullopt;
    text->assign(reinterpret_cast<const char*>(bytes.data()), static_cast<std::size_t>(length));
    bytes = bytes.subspan(static_cast<std::size_t>(length));
  }
  return bytes.empty() ? std::optional(key) : std::nullopt;
}

/// Throws the error of a file that has the journal's name, and can't be a journal.
[[noreturn]] void refuse_place(const fs::path& path, int error) {
  if (error == ELOOP) refuse(path, "is a symbolic link", "move it away, or name another output");
  if (error == EISDIR) refuse(path, "is a directory", "move it away, or name another output");
  refuse(path, error);
}

void require_regular(const fs::path& path, mode_t mode) {
  if (S_ISDIR(mode)) refuse_place(path, EISDIR);
  if (!S_ISREG(mode)) refuse(path, "is not a regular file", "move it away, or name another output");
}

[[noreturn]] void refuse_busy(const fs::path& output) {
  throw BusyError(quoted_name(output.string()) + " is being written by another run; wait for its end, or " +
                  name_another(output.string()));
}

fs::path journal_of(const fs::path& output) { return fs::path(output) += journal_ending; }

}  // namespace

void require_idle(const fs::path& output) {
  const fs::path path = journal_of(target_of(output));
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)};
  if (file.number() < 0 && errno == ENOENT) return;
  struct stat opened {};
  if (file.number() < 0 || ::fstat(file.number(), &opened) != 0) refuse_place(path, errno);
  require_regular(path, opened.st_mode);
  if (::flock(file.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse_busy(output);
}

OtherRun::OtherRun(const fs::path& output, JournalKey key)
    : IoError(quoted_name(journal_of(output).string()) +
              " has the finished points of another run; run that again to complete it, begin anew with --restart, or " +
              name_another(output.string())),
      key_(std::move(key)) {}

Journal::Journal(const fs::path& output, JournalKey key, const RecordLimit& limit, Begin begin, const ResultSink& take)
    : output_(target_of(output)), path_(journal_of(output_)), key_(std::move(key)) {
  lock();
  try {
    read(take, limit, begin);
  } catch (...) {
    if (size_ == 0) unlink();
    throw;
  }
}

Journal::~Journal() {
  if (file_.number() >= 0 && size_ == 0) unlink();
}

/// Removes the file, unless someone has done so: then the name may be another run's.
void Journal::unlink() const {
  if (is_named(file_, path_)) ::unlink(path_.c_str());
}

/// Opens the file that has the journal's name and locks it. Tries again if the run that held the lock has removed the
/// file meanwhile.
void Journal::lock() {
  struct stat older {};
  const bool is_rerun = ::stat(output_.c_str(), &older) == 0;
  const mode_t mode = is_rerun ? (older.st_mode & 0666) | 0600 : 0666;  // as private as the output
  for (;;) {
    file_ = Descriptor{uninterrupted([&] {
      return ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, mode);
    })};
    if (file_.number() < 0) refuse_place(path_, errno);
    if (uninterrupted([&] { return ::flock(file_.number(), LOCK_EX | LOCK_NB); }) != 0) {
      if (errno == EWOULDBLOCK) file_ = Descriptor{-1}, refuse_busy(output_);
      is_locked_ = false;
    }
    if (!is_named(file_, path_)) continue;
    struct stat opened {};
    if (::fstat(file_.number(), &opened) != 0) refuse(path_, errno);
    require_regular(path_, opened.st_mode);
    size_ = static_cast<std::uint64_t>(opened.st_size), stored_ = stored_bytes(opened);
    return;
  }
}

void Journal::read(const ResultSink& take, const RecordLimit& limit, Begin begin) {
  BlockReader reader(file_, size_, path_);
  std::array<char, magic.size()> first{};
  const std::span<char> found = std::span(first).first(std::min<std::size_t>(first.size(), reader.left()));
  reader.read(std::as_writable_bytes(found));
  if (std::string_view(found.data(), found.size()) != magic.substr(0, found.size()))
    throw IoError(quoted_name(path_.string()) + " is not a journal of clatter; move it away, or name another output");
  std::uint64_t whole = 0;  // bytes up to the end of the last whole record
  const bool is_anew = begin == Begin::restart || found.size() < magic.size();
  const auto header = is_anew ? std::nullopt : reader.block(most_header);
  if (header) {
    const auto key = key_of(*header);
    if (!key) reader.damaged(magic.size());
    // A log may be longer than its file takes on the disk, if zeros are stored as holes; but within limits.
    const double most_bytes = limit.bytes + (limit.has_log ? 1000.0 * static_cast<double>(stored_) : 0.0);
    if (*key != key_ && reader.head(std::numeric_limits<double>::infinity())) throw OtherRun(output_, *key);
    while (const auto record = *key == key_ ? reader.block(most_bytes) : std::nullopt) {
      take(*record);
      ends_.push_back(whole = reader.at());
    }
  }
  if (begin == Begin::resume && whole == 0)
    throw IoError("there is nothing to resume: " + quoted_name(path_.string()) +
                  " holds no finished points; leave --resume out");
  if (uninterrupted([&] { return ::ftruncate(file_.number(), static_cast<off_t>(whole)); }) != 0) refuse(path_, errno);
  size_ = whole;
}

void Journal::append(std::span<const std::byte> record) {
  Bytes bytes;
  if (size_ == 0) append_bytes(bytes, bytes_of(magic)), append_block(bytes, bytes_of(key_));
  append_number(bytes, head_of(record));
  synced_ = false;
  try {
    write_all(file_, bytes, path_), write_all(file_, record, path_);
  } catch (...) {
    (void)!::ftruncate(file_.number(), static_cast<off_t>(size_));  // else the next run cuts it
    throw;
  }
  ends_.push_back(size_ += bytes.size() + record.size());
}

void Journal::sync() {
  if (synced_) return;
  if (uninterrupted([&] { return ::fdatasync(file_.number()); }) != 0) refuse(path_, errno);
  if (!named_) sync_directory(path_);
  synced_ = named_ = true;
}

void Journal::give_back(std::uint64_t bytes) {
  if (bytes > size_) return;
  const std::uint64_t most = size_ - bytes;
  while (!ends_.empty() && ends_.back() > most) ends_.pop_back();
  size_ = ends_.empty() ? 0 : ends_.back();
  gave_back_ = true;
  if (uninterrupted([&] { return ::ftruncate(file_.number(), static_cast<off_t>(size_)); }) != 0) refuse(path_, errno);
}

std::string Journal::leave() {
  if (!is_named(file_, path_)) return "the journal was removed, and the finished points with it";
  if (size_ > 0)
    return (gave_back_ ? "a part of the finished points is in " : "the finished points are in ") +
           quoted_name(path_.string()) +
           "; the same command continues from there, or one with -o FILE after that is moved to FILE.journal";
  unlink();
  return gave_back_ ? "the journal was cut to make room for the output, so the finished points have to be run again"
                    : "no point was finished yet";
}

void Journal::remove() {
  if (is_named(file_, path_) && ::unlink(path_.c_str()) != 0) refuse(path_, errno);
  file_ = Descriptor{-1};
}

}  // namespace clatter::storage
