#include "storage/run_in_child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <span>

#include "storage/error.hpp"
#include "storage/file_calls.hpp"

namespace clatter::storage {
namespace {

// Sanitizers reserve terabytes of addresses, so no limit of addresses can be set, and report why the child dies.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool sanitized = false;
#endif

enum class Outcome : std::uint64_t { result, io_error, no_memory, bug };

/// The head of the bytes that the child sends.
struct Head {
  Outcome outcome;
  std::uint64_t length;
};

[[noreturn]] void refuse_child(int error) {
  throw IoError{"no process can be started to read a file: " +
                reason_and_way_out(error, "end some others and try again")};
}

/// Throws if there are too few descriptors for the child, which would otherwise blame the file that it reads.
void require_descriptors(const Descriptor& any) {
  const auto another = [&] { return Descriptor{::dup(any.number())}; };
  const std::array<Descriptor, 3> needed{another(), another(),
                                         another()};  // the file, opened twice by HDF5, and /dev/null
  if (needed.back().number() < 0) refuse_child(errno);
}

// --- the child --------------------------------------------------------------

void lower_limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  ::setrlimit(resource, &limit);
}

/// The size of this process's address space; nothing if it isn't known, and then no limit can be set.
std::optional<std::uint64_t> address_space() {
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return std::nullopt;
  unsigned long pages = 0;
  const bool found = std::fscanf(file, "%lu", &pages) == 1;
  std::fclose(file);
  if (!found) return std::nullopt;
  return std::uint64_t{pages} * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Makes the child die quietly: no core dump, no message of the C library, none of the parent's signal handlers.
void die_quietly() {
  ::prctl(PR_SET_DUMPABLE, 0);
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGPIPE}) std::signal(number, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
}

void become_child(pid_t parent, const ChildLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);                                                     // it ended before prctl
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(number, SIG_IGN);  // the parent decides
  if (!sanitized) die_quietly();
  lower_limit(RLIMIT_CPU, limits.seconds);
  if (!sanitized) lower_limit(RLIMIT_FSIZE, 0);  // it has nothing to write, not even if a file exploits the library
  const auto taken = address_space();
  if (!sanitized && taken) lower_limit(RLIMIT_AS, *taken + limits.memory);
}

void send(int pipe, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = uninterrupted([&] { return ::write(pipe, bytes.data(), bytes.size()); });
    if (written < 0) ::_exit(1);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void send(int pipe, Outcome outcome, const std::string& bytes) {
  const Head head{outcome, bytes.size()};
  send(pipe, std::as_bytes(std::span(&head, 1)));
  send(pipe, std::as_bytes(std::span(bytes)));
}

/// Ends without destructors and exit handlers, which are the parent's.
[[noreturn]] void run_child(int pipe, const std::function<std::string()>& work) {
  try {
    send(pipe, Outcome::result, work());
  } catch (const IoError& error) {
    send(pipe, Outcome::io_error, error.what());
  } catch (const std::bad_alloc&) {
    send(pipe, Outcome::no_memory, "");
  } catch (const std::exception& error) {
    send(pipe, Outcome::bug, error.what());
  } catch (...) {
    send(pipe, Outcome::bug, "an unknown exception");
  }
  ::_exit(0);
}

// --- the parent -------------------------------------------------------------

/// Owns a child process; kills it if it is destroyed before the child has ended.
class Child {
 public:
  explicit Child(pid_t id) : id_{id} {}
  ~Child() {
    if (id_ < 0) return;
    ::kill(id_, SIGKILL);
    (void)wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its exit status; nothing if SIGCHLD is ignored, since the system then keeps none.
  std::optional<int> wait() {
    int status = 0;
    const pid_t ended = uninterrupted([&] { return ::waitpid(id_, &status, 0); });
    id_ = -1;
    return ended < 0 ? std::nullopt : std::optional(status);
  }

 private:
  pid_t id_;
};

using Clock = std::chrono::steady_clock;

/// Waits until there is something to read, or the other end is closed; false once the time is over.
bool has_come(const Descriptor& pipe, Clock::time_point end) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd waiting{pipe.number(), POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::min<std::int64_t>(left, 1'000'000)));
    if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
  }
}

/// Reads until `to` is full; false if the child ends before. Throws ChildFailed once the time is over.
bool receive(const Descriptor& pipe, std::span<std::byte> to, const ChildLimits& limits, Clock::time_point end) {
  while (!to.empty()) {
    if (!has_come(pipe, end))
      throw ChildFailed{"reading it didn't finish within " + std::to_string(limits.wall_seconds) + " s"};
    const ssize_t got = uninterrupted([&] { return ::read(pipe.number(), to.data(), to.size()); });
    if (got <= 0) return false;
    to = to.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

std::string reason(std::optional<int> status, const ChildLimits& limits) {
  if (!status || !WIFSIGNALED(*status)) return "it makes the HDF5 library exit";
  const int number = WTERMSIG(*status);
  if (number == SIGXCPU)
    return "reading it didn't finish within " + std::to_string(limits.seconds) + " s of processor time";
  if (number == SIGKILL) return "the process that read it was killed, perhaps because memory ran out";
  const char* const name = ::sigabbrev_np(number);
  return std::string("it makes the HDF5 library crash (SIG") + (name == nullptr ? "?" : name) + ')';
}

}  // namespace

ChildLimits limits_for(std::uint64_t stored_bytes) {
  ChildLimits limits;
  limits.memory += 2 * stored_bytes;
  limits.seconds += stored_bytes >> 24U;
  limits.wall_seconds += stored_bytes >> 20U;  // the network may be slow
  return limits;
}

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse_child(errno);
  const Descriptor from{ends[0]};
  Descriptor to{ends[1]};
  require_descriptors(from);
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id < 0) refuse_child(errno);
  if (id == 0) {
    become_child(parent, limits);
    run_child(to.number(), work);
  }
  Child child{id};
  (void)to.close();
  const Clock::time_point end = Clock::now() + std::chrono::seconds{limits.wall_seconds};
  Head head{};
  std::string bytes;
  if (!receive(from, std::as_writable_bytes(std::span(&head, 1)), limits, end))
    throw ChildFailed{reason(child.wait(), limits)};
  if (head.length > limits.memory) throw ChildFailed{"the HDF5 library reads more from it than it can hold"};
  bytes.resize(static_cast<std::size_t>(head.length));
  if (!receive(from, std::as_writable_bytes(std::span(bytes)), limits, end))
    throw ChildFailed{reason(child.wait(), limits)};
  (void)child.wait();
  if (head.outcome == Outcome::io_error) throw IoError{bytes};
  if (head.outcome == Outcome::no_memory) throw ChildFailed{"reading it takes more memory than there is"};
  if (head.outcome == Outcome::bug) throw std::logic_error{bytes};
  if (head.outcome != Outcome::result) throw ChildFailed{"it makes the HDF5 library corrupt its memory"};
  return bytes;
}

}  // namespace clatter::storage
