#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "config/config.hpp"

namespace clatter::config {

/// A directory that lives as long as the test, so that tests can run side by side.
class TemporaryDirectory {
 public:
  TemporaryDirectory() : path_(std::filesystem::temp_directory_path() / ("clatter-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }

  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

  [[nodiscard]] std::string prefix() const { return path_.string() + '/'; }

 private:
  std::filesystem::path path_;
};

/// The configuration that a text means; the name says whether it is TOML or INI.
inline Config read_as(const std::string& name, const std::string& text, const std::vector<Override>& overrides = {}) {
  const TemporaryDirectory directory;
  return read_config(directory.file(name, text), overrides);
}

/// What is wrong with a text, e.g. "a.toml:2:5: ..."; empty where nothing is.
inline std::string mistake_in(const std::string& name, const std::string& text,
                              const std::vector<Override>& overrides = {}) {
  const TemporaryDirectory directory;
  try {
    (void)read_config(directory.file(name, text), overrides);
  } catch (const ConfigError& error) {
    const std::string message = error.what();
    return message.starts_with(directory.prefix()) ? message.substr(directory.prefix().size()) : message;
  }
  return {};
}

}  // namespace clatter::config
