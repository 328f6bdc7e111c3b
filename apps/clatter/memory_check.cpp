#include "memory_check.hpp"

#include <string>

#include "format.hpp"
#include "io/error.hpp"
#include "sweep/memory.hpp"

namespace clatter {

void check_memory(const Sweep& sweep, const std::optional<Shard>& shard) {
  const double needed = run_bytes(sweep, shard), there = machine_bytes();
  if (there == 0 || needed <= there) return;
  throw IoError("the results of " + std::to_string(Share(sweep, shard).points()) +
                " points, and the largest variable of them once more, take " + bytes_text(needed) + ", there are " +
                bytes_text(there) +
                "; sweep fewer points, observe fewer samples and harmonics, or share the points out with --shard");
}

}  // namespace clatter
