// `clatter info` on damaged files.
#include "hdf5_target.hpp"
#include "outputs/output_summary.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clatter::fuzz::check_reading({data, size},
                               [](const std::string& path) { (void)clatter::outputs::read_summary(path); });
  return 0;
}
