// `clatter merge` on damaged files with a valid checksum trailer: that reveals any other damage.
#include <string>

#include "hdf5_target.hpp"
#include "outputs/merge.hpp"
#include "results/checksum_trailer.hpp"
#include "storage/crc32.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clatter;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::string with_trailer =
      bytes + results::checksum_trailer_of(size, storage::crc32_of(std::as_bytes(std::span(bytes))));
  fuzz::check_reading({reinterpret_cast<const std::uint8_t*>(with_trailer.data()), with_trailer.size()},
                      [](const std::string& path) { (void)outputs::shard_set({path}); });
  return 0;
}
