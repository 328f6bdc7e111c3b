// Configurations in INI.
#include "configuration.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clatter::fuzz::check_configuration("input.ini", std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
