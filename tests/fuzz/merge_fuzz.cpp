// `clatter merge` on damaged files with a valid checksum trailer: that reveals any other damage.
#include <string>

#include "hdf5_target.hpp"
#include "results/checksum_trailer.hpp"
#include "results/shard_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clatter;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::string with_trailer = bytes + results::checksum_trailer_of(std::as_bytes(std::span(bytes)));
  fuzz::check_reading({reinterpret_cast<const std::uint8_t*>(with_trailer.data()), with_trailer.size()},
                      [](const std::string& path) { (void)results::read_shard_header(path); });
  return 0;
}
