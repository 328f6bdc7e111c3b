#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include "finding.hpp"

namespace clatter::fuzz {

/// A directory of this process for the files that are read: in $TMPDIR, else in memory. Removed at the end, unless
/// there is a finding.
class Scratch {
 public:
  Scratch() {
    const char* const given = std::getenv("TMPDIR");
    path_ = std::string(given == nullptr ? "/dev/shm" : given) + "/clatter-fuzz-" + std::to_string(::getpid());
    std::filesystem::create_directories(path_);
  }
  ~Scratch() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return path_ + '/' + name; }

 private:
  std::string path_;
};

inline const Scratch& scratch() {
  static const Scratch the;
  return the;
}

/// Writes a file of the scratch directory; returns its path.
inline std::string write(const std::string& name, std::span<const std::byte> bytes) {
  const std::string path = scratch().path(name);
  std::ofstream file{path, std::ios::binary};
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  require(file.good(), "cannot write " + path);
  return path;
}

inline std::string write(const std::string& name, const std::string& text) {
  return write(name, std::as_bytes(std::span(text)));
}

inline std::string content(const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

}  // namespace clatter::fuzz
