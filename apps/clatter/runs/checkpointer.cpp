#include "runs/checkpointer.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "commands/commands.hpp"
#include "storage/error.hpp"
#include "storage/file_calls.hpp"
#include "storage/utf8.hpp"
#include "terminal/signals.hpp"

namespace clatter::app {
namespace {

constexpr char over = 0;  ///< in the pipe; other bytes are the numbers of signals

constexpr std::chrono::seconds interval{1};

constexpr std::array stops{SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t into = -1;  ///< the pipe of the present Checkpointer

void take_checkpoint_signal(int number) {
  const int before = errno;
  handle(stops, SIG_DFL);  // the next signal ends the process
  const char byte = static_cast<char>(number);
  (void)!::write(into, &byte, 1);
  errno = before;
}

}  // namespace

Checkpointer::Checkpointer(storage::Journal& journal, std::function<void()> save, std::optional<Clock::time_point> end)
    : journal_(journal), save_(std::move(save)), end_(end) {
  if (::pipe2(ends_, O_CLOEXEC) != 0)
    throw storage::IoError("cannot make a pipe: " + storage::reason_and_way_out(errno, ""));
  into = ends_[1];
  try {
    thread_ = std::thread([this] { keep(); });
  } catch (const std::system_error& error) {
    for (const int number : ends_) ::close(number);
    throw storage::IoError(std::string("cannot start a thread: ").append(error.what()).append("; raise ulimit -u"));
  }
  handle(stops, take_checkpoint_signal);
}

Checkpointer::~Checkpointer() {
  {
    const std::lock_guard lock(saving_);
    if (!finishing_) save_if_possible();
    finishing_ = true;
  }
  handle(stops, SIG_DFL);
  (void)!::write(ends_[1], &over, 1);
  thread_.join();
  for (const int end : ends_) ::close(end);
}

/// Waits until a signal, `over` or the end of the time, but at most a second. Returns the signal's number, `over`,
/// SIGALRM for the end of the time, or -1 after a second.
char Checkpointer::wait() const {
  using Milliseconds = std::chrono::milliseconds;
  const Clock::time_point next = Clock::now() + interval, until = end_ ? std::min(next, *end_) : next;
  for (;;) {
    const auto left = std::chrono::ceil<Milliseconds>(until - Clock::now());
    if (left.count() <= 0) return end_ && Clock::now() >= *end_ ? char{SIGALRM} : char{-1};
    pollfd pipe{ends_[0], POLLIN, 0};
    if (::poll(&pipe, 1, static_cast<int>(left.count())) <= 0) continue;
    char came = over;
    if (::read(ends_[0], &came, 1) == 1) return came;
  }
}

void Checkpointer::finish() {
  const std::lock_guard lock(saving_);
  if (journal_.has_records() || Clock::now() - begin_ > interval) save_if_possible();
  finishing_ = true;
}

void Checkpointer::keep() {
  for (;;) {
    const char came = wait();
    if (came == over) return;
    const std::lock_guard lock(saving_);
    if (finishing_) {
      end_.reset();
      if (std::ranges::find(stops, came) != stops.end())
        std::cerr << "\nclatter: writing the output; a second signal stops at once\n";
    } else if (came == SIGINT) {
      stop(128 + SIGINT, "interrupted");
    } else if (came == SIGTERM) {
      stop(128 + SIGTERM, "terminated");
    } else if (came == SIGHUP) {
      stop(128 + SIGHUP, "its terminal is closed");
    } else if (came == SIGALRM) {
      stop(timed_out, "--max-time is over");
    } else {
      save();
    }
  }
}

/// If points can't be saved, the run stops: going on would compute what may be lost.
void Checkpointer::save() try { save_(); } catch (const std::bad_alloc&) {
  give_up(storage::no_memory("it ran out").what());
} catch (const std::exception& error) {
  give_up(error.what());
}

void Checkpointer::give_up(const char* why) {
  std::cerr << "\nclatter: " << storage::printable_lines(why) << "\nclatter: stopped; "
            << storage::printable(journal_.leave()) << std::endl;
  ::_exit(io_error);
}

void Checkpointer::save_if_possible() {
  try {
    save_();
  } catch (const std::exception&) {  // the error of the output, which comes next, tells more
  }
}

void Checkpointer::stop(int code, const std::string& why) {
  std::cerr << "\nclatter: " << why << "; saving finished points" << std::endl;
  save();
  std::cerr << "clatter: " << storage::printable(journal_.leave()) << std::endl;
  ::_exit(code);
}

}  // namespace clatter::app
