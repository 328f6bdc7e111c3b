#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace clatter::plan {

/// Memory that a run may have at its most, counted as `MemoryNeed` counts it, and who says so.
struct MemoryLimit {
  double bytes = std::numeric_limits<double>::infinity();
  std::string name;  ///< "this machine has", "ulimit -v leaves"
};

/// The limits of the control groups that this process is in (a job of a batch system, a container), of versions 1 and
/// 2, from its own groups up to the outermost that is seen. `root` is that of the file system.
[[nodiscard]] std::vector<MemoryLimit> group_limits(const std::filesystem::path& root = "/");

/// What a process has, in bytes, as /proc/self/statm tells it.
struct ProcessSize {
  double addresses = 0.0, resident = 0.0, data = 0.0;
};

/// What limits of addresses and of data (0: none) leave of memory to a process that will start so many threads.
[[nodiscard]] std::vector<MemoryLimit> address_limits(double addresses, double data, const ProcessSize& now,
                                                      int threads);

/// The narrowest limit of this machine, the control groups, `ulimit -v` and `ulimit -d`.
[[nodiscard]] MemoryLimit memory_limit(int threads);

/// The most memory that this process has held so far; 0 where that isn't told.
[[nodiscard]] double peak_bytes();

}  // namespace clatter::plan
