#pragma once

namespace clatter::app {

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
