#include "keeper.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <exception>
#include <iostream>
#include <string>
#include <system_error>
#include <utility>

#include "commands.hpp"

namespace clatter {
namespace {

constexpr char over = 0;  ///< in the pipe, beside the numbers of signals

volatile std::sig_atomic_t into = -1;  ///< the pipe of the present keeper

void take(int number) {
  const int before = errno;
  std::signal(number, SIG_DFL);  // the next one ends the process
  const char byte = static_cast<char>(number);
  (void)!::write(into, &byte, 1);
  errno = before;
}

}  // namespace

Keeper::Keeper(Journal& journal, std::function<void()> save, std::optional<Seconds> longest)
    : journal_(journal), save_(std::move(save)) {
  if (longest) end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(*longest);
  if (::pipe2(ends_, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "no pipe");
  into = ends_[1];
  thread_ = std::thread([this] { keep(); });
  for (const int number : {SIGINT, SIGTERM})
    if (std::signal(number, take) == SIG_IGN) std::signal(number, SIG_IGN);  // as a shell wants it in the background
}

Keeper::~Keeper() {
  for (const int number : {SIGINT, SIGTERM})
    if (std::signal(number, SIG_DFL) == SIG_IGN) std::signal(number, SIG_IGN);
  (void)!::write(ends_[1], &over, 1);
  thread_.join();
  for (const int end : ends_) ::close(end);
}

/// Waits for a second, or for what comes before: the number of a signal, `over`, SIGALRM for the end of the time;
/// -1: a second has passed.
char Keeper::wait() const {
  using Milliseconds = std::chrono::milliseconds;
  const Clock::time_point next = Clock::now() + std::chrono::seconds(1), until = end_ ? std::min(next, *end_) : next;
  for (;;) {
    const auto left = std::chrono::ceil<Milliseconds>(until - Clock::now());
    if (left.count() <= 0) return end_ && Clock::now() >= *end_ ? char{SIGALRM} : char{-1};
    pollfd pipe{ends_[0], POLLIN, 0};
    if (::poll(&pipe, 1, static_cast<int>(left.count())) <= 0) continue;
    char came = over;
    if (::read(ends_[0], &came, 1) == 1) return came;
  }
}

void Keeper::keep() {
  for (;;) {
    const char came = wait();
    if (came == over) return;
    try {
      save_();
    } catch (const std::exception& error) {
      leave(io_error, std::string(error.what()).append("\nclatter: stopped"));
    }
    if (came == SIGINT) leave(128 + SIGINT, "interrupted");
    if (came == SIGTERM) leave(128 + SIGTERM, "terminated");
    if (came == SIGALRM) leave(timed_out, "--max-time is over");
  }
}

void Keeper::leave(int code, const std::string& why) {
  const std::string saved = journal_.leave();
  std::cerr << "\nclatter: " << why << "; " << saved << std::endl;
  ::_exit(code);
}

}  // namespace clatter
