#include "terminal/signals.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace clatter::app {
namespace {

constexpr std::array ending_signals{SIGINT, SIGTERM};

volatile std::sig_atomic_t came = 0;

void take_signal(int number) {
  const int before = errno;
  came = number;
  handle(ending_signals, SIG_DFL);  // the next signal of either kind ends the process
  static constexpr std::array message =
      std::to_array("\nclatter: stopping after the present run; a second signal stops at once\n");
  (void)!write(STDERR_FILENO, message.data(), message.size() - 1);  // a signal handler may call little else
  errno = before;
}

}  // namespace

void handle(std::span<const int> signals, void (*handler)(int)) {
  for (const int number : signals)
    if (std::signal(number, handler) == SIG_IGN) std::signal(number, SIG_IGN);
}

Interrupt::Interrupt() {
  came = 0;
  handle(ending_signals, take_signal);
}

Interrupt::~Interrupt() { handle(ending_signals, SIG_DFL); }

int Interrupt::signal() { return came; }

}  // namespace clatter::app
