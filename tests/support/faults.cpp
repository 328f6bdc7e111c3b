// Preloaded into clatter by tests/cli/faults_test.py: makes one call on a file fail. CLATTER_FAULT has the name of the
// call, its number (0: every second one), and the fault, e.g. "write 3 ENOSPC", "rename 1 kill", "write 0 short". The
// file that CLATTER_FAULT_DONE names is created when the fault happens. Counts comparisons of texts, too.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

struct Fault {
  std::string call, effect;
  long which = -1, calls = 0;

  Fault() {
    const char* const text = std::getenv("CLATTER_FAULT");
    if (text == nullptr) return;
    const std::string words = text;
    const std::size_t first = words.find(' '), second = words.find(' ', first + 1);
    call = words.substr(0, first), effect = words.substr(second + 1);
    which = std::stol(words.substr(first + 1, second - first - 1));
  }

  int error() const {
    if (effect == "ENOSPC") return ENOSPC;
    if (effect == "EINTR") return EINTR;
    return EIO;
  }
};

Fault& fault() {
  static Fault the_fault;
  return the_fault;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// Whether this call is the one to fail; doesn't return if the fault is to kill the process.
bool goes_wrong(const char* call) {
  if (fault().call != call) return false;
  ++fault().calls;
  if (fault().which == 0 ? fault().calls % 2 == 0 : fault().calls != fault().which) return false;
  if (const char* const done = std::getenv("CLATTER_FAULT_DONE")) {
    static const auto open_file = next<int (*)(const char*, int, ...)>("open");
    (void)open_file(done, O_CREAT | O_WRONLY, 0666);
  }
  if (fault().effect == "kill") std::raise(SIGKILL);
  if (fault().effect != "TERM") return true;
  ::kill(::getpid(), SIGTERM);
  return false;
}

bool is_regular(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

int fails() {
  errno = fault().error();
  return -1;
}

}  // namespace

/// Comparisons of texts, told at the end in the file that CLATTER_COMPARISONS names.
struct Comparisons {
  unsigned long count = 0;

  ~Comparisons() {
    const char* const name = std::getenv("CLATTER_COMPARISONS");
    if (name == nullptr) return;
    static const auto open_file = next<int (*)(const char*, int, ...)>("open");
    static const auto write_file = next<ssize_t (*)(int, const void*, size_t)>("write");
    const std::string text = std::to_string(count);
    const int file = open_file(name, O_CREAT | O_WRONLY | O_TRUNC, 0666);
    if (write_file(file, text.data(), text.size()) < 0) std::abort();
  }
};

Comparisons comparisons;

extern "C" {

int memcmp(const void* one, const void* other, size_t length) noexcept {
  ++comparisons.count;
  const auto *a = static_cast<const unsigned char*>(one), *b = static_cast<const unsigned char*>(other);
  for (std::size_t i = 0; i < length; ++i)
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  return 0;
}

ssize_t write(int file, const void* bytes, size_t count) {
  static const auto call = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (!is_regular(file) || !goes_wrong("write")) return call(file, bytes, count);
  if (fault().effect == "short") return call(file, bytes, (count + 1) / 2);
  return fails();
}

/// A write at a place is a write.
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  static const auto call = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  if (!is_regular(file) || !goes_wrong("write")) return call(file, bytes, count, at);
  if (fault().effect == "short") return call(file, bytes, (count + 1) / 2, at);
  return fails();
}

ssize_t read(int file, void* bytes, size_t count) {
  static const auto call = next<ssize_t (*)(int, void*, size_t)>("read");
  if (!is_regular(file) || !goes_wrong("read")) return call(file, bytes, count);
  if (fault().effect == "short") return call(file, bytes, (count + 1) / 2);
  return fails();
}

int open(const char* path, int flags, ...) {
  static const auto call = next<int (*)(const char*, int, ...)>("open");
  va_list rest;
  va_start(rest, flags);
  const bool creates = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  const mode_t mode = creates ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & (O_CREAT | O_DIRECTORY)) != 0 && goes_wrong("open")) return fails();
  return call(path, flags, mode);
}

int fdatasync(int file) {
  static const auto call = next<int (*)(int)>("fdatasync");
  return goes_wrong("fdatasync") ? fails() : call(file);
}

int fsync(int file) {
  static const auto call = next<int (*)(int)>("fsync");
  return goes_wrong("fsync") ? fails() : call(file);
}

int ftruncate(int file, off_t length) noexcept {
  static const auto call = next<int (*)(int, off_t)>("ftruncate");
  return goes_wrong("ftruncate") ? fails() : call(file, length);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  static const auto call = next<int (*)(int, const char*, int, const char*, int)>("linkat");
  return goes_wrong("linkat") ? fails() : call(from_folder, from, to_folder, to, flags);
}

int rename(const char* from, const char* to) noexcept {
  static const auto call = next<int (*)(const char*, const char*)>("rename");
  return goes_wrong("rename") ? fails() : call(from, to);
}

int unlink(const char* path) noexcept {
  static const auto call = next<int (*)(const char*)>("unlink");
  return goes_wrong("unlink") ? fails() : call(path);
}
}
