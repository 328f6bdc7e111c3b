#include "sweep/memory.hpp"

#include <cstdint>

#include "sweep/columns.hpp"

namespace clatter {

double result_bytes(const Sweep& sweep) {
  double bytes_a_point = sizeof(std::uint8_t) + sizeof(std::int64_t) + sizeof(double);  // status, impacts, periods
  for (const Output& output : outputs_of(sweep.scene.observe))
    bytes_a_point += static_cast<double>(output.width) * sizeof(double);
  return bytes_a_point * static_cast<double>(size(sweep));
}

}  // namespace clatter
