#include "signals.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <initializer_list>

namespace clatter::app {
namespace {

volatile std::sig_atomic_t came = 0;

void take(int number) {
  came = number;
  std::signal(number, SIG_DFL);
  static constexpr std::array message =
      std::to_array("\nclatter: stopping after the present run; a second signal stops at once\n");
  (void)!write(STDERR_FILENO, message.data(), message.size() - 1);  // a signal handler may call little else
}

}  // namespace

Interrupt::Interrupt() {
  came = 0;
  for (const int number : {SIGINT, SIGTERM})
    if (std::signal(number, take) == SIG_IGN) std::signal(number, SIG_IGN);  // as a shell does for background jobs
}

Interrupt::~Interrupt() {
  for (const int number : {SIGINT, SIGTERM})
    if (std::signal(number, SIG_DFL) == SIG_IGN) std::signal(number, SIG_IGN);
}

int Interrupt::signal() { return came; }

}  // namespace clatter::app
