#pragma once

namespace clatter::app {

/// Takes SIGINT and SIGTERM as a wish to stop; a second one stops at once, as by default.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] static int signal();  ///< that came, 0: none
};

}  // namespace clatter::app
