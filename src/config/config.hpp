#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sweep/sweep.hpp"

namespace clatter::config {

enum class Format { toml, ini };

/// What looks unintended in a configuration, and is no mistake.
struct Warning {
  std::string location;  ///< "fig22.toml:7:6", or the words of a --set
  std::string section;   ///< of the key
  std::string text;      ///< what it is; the way out
};

/// A complete configuration: what is swept, what is observed, how it is written.
struct Config {
  std::string title;
  std::string source;
  sweep::Sweep sweep;
  int compression = 0;  ///< deflate level of the output, 0 ... 9
  std::string text;     ///< all of it with the defaults filled in, as TOML that runs again (root attribute `config`)
  std::vector<Warning> warnings;
  std::vector<std::string> notes;  ///< what the command line says in place of the file in another way
};

/// A mistake of the user's: `what()` is one line, "file:line:column: what is wrong; the way out".
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A --set KEY=VALUE of the command line, e.g. {"sweep.nu", "linspace(0.5, 1.5, 51)"}.
struct Override {
  std::string key;
  std::string value;
};

/// The name of standard input among the operands.
inline constexpr std::string_view standard_input = "-";

/// Reads a configuration; INI where the name ends in .ini in any case or the format says so, else TOML. Throws
/// ConfigError; IoError where the file cannot be read.
[[nodiscard]] Config read_config(const std::string& path, const std::vector<Override>& overrides,
                                 Format format = Format::toml);

/// Reads a configuration from TOML, such as the complete text of another one; `file` is named in errors.
[[nodiscard]] Config parse_config(const std::string& text, const std::string& file);

}  // namespace clatter::config
