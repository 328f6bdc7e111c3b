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
  {
    const std::lock_guard lock(saving_);
    if (!finishing_) save_if_possible();
    finishing_ = true;
  }
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

void Keeper::finish() {
  const std::lock_guard lock(saving_);
  if (journal_.has_records()) save_if_possible();
  finishing_ = true;
}

void Keeper::keep() {
  for (;;) {
    const char came = wait();
    if (came == over) return;
    const std::lock_guard lock(saving_);
    if (finishing_) {
      end_.reset();
      if (came == SIGINT || came == SIGTERM)
        std::cerr << "\nclatter: the output is being written; once more stops at once\n";
    } else if (came == SIGINT) {
      stop(128 + SIGINT, "interrupted");
    } else if (came == SIGTERM) {
      stop(128 + SIGTERM, "terminated");
    } else if (came == SIGALRM) {
      stop(timed_out, "--max-time is over");
    } else {
      save();
    }
  }
}

/// Where points can't be kept, the run isn't worth going on with.
void Keeper::save() try { save_(); } catch (const std::exception& error) {
  std::cerr << "\nclatter: " << error.what() << "\nclatter: stopped; " << journal_.leave() << std::endl;
  ::_exit(io_error);
}

void Keeper::save_if_possible() {
  try {
    save_();
  } catch (const std::exception&) {  // what comes next tells more
  }
}

void Keeper::stop(int code, const std::string& why) {
  std::cerr << "\nclatter: " << why << "; saves what is finished" << std::endl;
  save();
  std::cerr << "clatter: " << journal_.leave() << std::endl;
  ::_exit(code);
}

}  // namespace clatter
