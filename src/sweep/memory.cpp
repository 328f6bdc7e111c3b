#include "sweep/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "sweep/columns.hpp"

namespace clatter {

double result_bytes(const Sweep& sweep, const std::optional<Shard>& shard) {
  double bytes_a_point = sizeof(std::uint8_t) + sizeof(std::int64_t) + sizeof(double);  // status, impacts, periods
  for (const Output& output : outputs_of(sweep.scene))
    bytes_a_point += static_cast<double>(output.width) * sizeof(double);
  if (shard) bytes_a_point += sizeof(std::int64_t);  // index in the sweep
  return bytes_a_point * static_cast<double>(Share(sweep, shard).points());
}

double run_bytes(const Sweep& sweep, const std::optional<Shard>& shard) {
  std::size_t width = 1;
  for (const Output& output : outputs_of(sweep.scene)) width = std::max(width, output.width);
  return result_bytes(sweep, shard) +
         static_cast<double>(width * sizeof(double)) * static_cast<double>(Share(sweep, shard).points());
}

double merge_bytes(const Sweep& sweep, std::span<const ShardSize> shards) {
  constexpr double logged = 3 * sizeof(double) + sizeof(std::int8_t);  // bytes of an impact in the file
  constexpr double heap = 2 * sizeof(void*);                           // taken with each block
  double impacts = 0.0, largest = 0.0;
  for (const ShardSize& size : shards) {
    impacts += static_cast<double>(size.impacts);
    largest = std::max(largest, result_bytes(sweep, size.shard) + logged * static_cast<double>(size.impacts));
  }
  double log = 0.0;
  if (sweep.scene.observe.impact_log)
    log = static_cast<double>(size(sweep)) * (sizeof(std::vector<Impact>) + heap) + impacts * sizeof(Impact);
  const double building = std::max(run_bytes(sweep), result_bytes(sweep) + impacts * sizeof(double));
  return std::max(result_bytes(sweep) + log + largest, building + log + logged * impacts);
}

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// The least limit of the control groups that this process is in, from its own up to the outermost.
double group_bytes() {
  double least = endless;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;  // version 2
    for (std::string group = line.substr(3);; group.erase(group.rfind('/'))) {
      double limit = 0;
      if (std::ifstream(std::string("/sys/fs/cgroup").append(group).append("/memory.max")) >> limit)
        least = std::min(least, limit);  // else "max", or none
      if (group.find('/') == std::string::npos) break;
    }
  }
  return least;
}

double machine_limit() {
  const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return bytes > 0 ? bytes : endless;
}

double address_limit() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? static_cast<double>(limit.rlim_cur)
                                                                              : endless;
}

}  // namespace

double machine_bytes() {
  const double bytes = std::min({machine_limit(), group_bytes(), address_limit()});
  return bytes < endless ? bytes : 0.0;
}

}  // namespace clatter
