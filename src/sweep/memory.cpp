#include "sweep/memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "sweep/columns.hpp"

namespace clatter {

double result_bytes(const Sweep& sweep) {
  double bytes_a_point = sizeof(std::uint8_t) + sizeof(std::int64_t) + sizeof(double);  // status, impacts, periods
  for (const Output& output : outputs_of(sweep.scene.observe))
    bytes_a_point += static_cast<double>(output.width) * sizeof(double);
  return bytes_a_point * static_cast<double>(size(sweep));
}

double run_bytes(const Sweep& sweep) {
  std::size_t width = 1;
  for (const Output& output : outputs_of(sweep.scene.observe)) width = std::max(width, output.width);
  return result_bytes(sweep) + static_cast<double>(width * sizeof(double)) * static_cast<double>(size(sweep));
}

double machine_bytes() {
  return std::max(0.0, static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

}  // namespace clatter
