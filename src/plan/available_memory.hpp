#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace clatter::plan {

/// The most memory that a run may have, counted as `MemoryNeed` counts it, and the source of the limit.
struct MemoryLimit {
  double bytes = std::numeric_limits<double>::infinity();
  std::string name;           ///< the source, in words: "this machine has", "ulimit -v leaves"
  bool of_addresses = false;  ///< files that are mapped count, too, though they take no memory

  /// The most memory besides files that are mapped.
  [[nodiscard]] double besides(double mapped) const { return of_addresses ? bytes - mapped : bytes; }
};

/// The limits of the control groups of this process (a job of a batch system, a container), versions 1 and 2, from its
/// own groups up to the outermost visible one. `root` is that of the file system.
[[nodiscard]] std::vector<MemoryLimit> group_limits(const std::filesystem::path& root = "/");

/// The size of a process in bytes, from /proc/self/statm.
struct ProcessSize {
  double addresses = 0.0, resident = 0.0, data = 0.0;
};

/// The memory that limits of addresses and of data leave to a process that will start `threads` threads.
[[nodiscard]] std::vector<MemoryLimit> address_limits(double addresses, double data, const ProcessSize& now,
                                                      int threads);

/// The narrowest limit of this machine, the control groups, `ulimit -v` and `ulimit -d` for a process that maps files
/// of so many bytes.
[[nodiscard]] MemoryLimit memory_limit(int threads, double mapped = 0.0);

/// The most memory that this process has held so far; 0 if the system doesn't tell.
[[nodiscard]] double peak_bytes();

}  // namespace clatter::plan
