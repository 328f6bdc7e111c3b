#pragma once

#include <span>

namespace clatter::app {

/// Sets the handler of each signal, but leaves ignored ones ignored: nohup, or a shell in the background, asked for it.
/// A signal handler may call it.
void handle(std::span<const int> signals, void (*handler)(int));

/// While it exists, the first SIGINT or SIGTERM asks the command to stop; a second one ends the process at once.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] static int signal();  ///< the one that came; 0: none
};

}  // namespace clatter::app
